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

std::vector<PartProgress> PartBoard::parts() const {
  const std::lock_guard lock(mutex_);
  return parts_;
}

}  // namespace hewn
