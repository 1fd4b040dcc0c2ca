#include "core/session/history.h"

#include <utility>

namespace hewn {

void History::reset(Document initial) {
  steps_.clear();
  steps_.push_back({{}, std::move(initial)});
  at_ = 0;
  ++edition_;
}

void History::push(std::string title, Document next) {
  steps_.resize(at_ + 1);
  steps_.push_back({std::move(title), std::move(next)});
  ++at_;
  ++edition_;
}

void History::amend(Document current) {
  steps_[at_].document = std::move(current);
  ++edition_;
}

bool History::undo() {
  if (!can_undo()) return false;
  --at_;
  ++edition_;
  return true;
}

bool History::redo() {
  if (!can_redo()) return false;
  ++at_;
  ++edition_;
  return true;
}

}  // namespace hewn
