#include "core/session/part_board.h"

#include <algorithm>

namespace hewn {

void PartBoard::update(const PartProgress& progress) {
  const std::lock_guard lock(mutex_);
  const auto it = std::find_if(parts_.begin(), parts_.end(), [&progress](const PartProgress& p) {
    return p.name == progress.name;
  });
  if (it == parts_.end()) {
    parts_.push_back(progress);
  } else if (!it->has_ended()) {
    // Several searches of one part report in turn; the bar does not go back.
    const double reached = it->share;
    *it = progress;
    if (progress.state == PartProgress::State::Running) it->share = std::max(it->share, reached);
  }
}

void PartBoard::stop() {
  const std::lock_guard lock(mutex_);
  for (PartProgress& part : parts_) {
    if (!part.has_ended()) part.state = PartProgress::State::Stopped;
  }
}

void PartBoard::stop(const std::string& name) {
  const std::lock_guard lock(mutex_);
  for (PartProgress& part : parts_) {
    if (part.name == name && !part.has_ended()) part.state = PartProgress::State::Stopped;
  }
  const auto token = tokens_.find(name);
  if (token != tokens_.end()) token->second->cancel();
}

std::shared_ptr<CancelToken> PartBoard::token_for(const std::string& name,
                                                  const std::shared_ptr<CancelToken>& whole) {
  auto token = std::make_shared<CancelToken>(whole);
  const std::lock_guard lock(mutex_);
  const bool is_stopped = std::any_of(parts_.begin(), parts_.end(), [&name](const auto& part) {
    return part.name == name && part.state == PartProgress::State::Stopped;
  });
  if (is_stopped) token->cancel();
  tokens_[name] = token;
  return token;
}

std::vector<PartProgress> PartBoard::parts() const {
  const std::lock_guard lock(mutex_);
  return parts_;
}

}  // namespace hewn
