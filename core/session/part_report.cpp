#include "core/session/part_report.h"

#include <utility>

namespace hewn {

PartReport::PartReport(PartBoard* board, std::string name) : board_(board), name_(std::move(name)) {
  tell({.name = name_});
}

void PartReport::begin() {
  start_ = Clock::now();
  running("search", 0);
}

void PartReport::running(const char* stage, double share) const {
  tell({.name = name_, .state = PartProgress::State::Running, .stage = stage, .share = share});
}

void PartReport::end(const Result<PartitionResult>& result) const {
  PartProgress last{.name = name_};
  last.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  if (result) {
    last.state = PartProgress::State::Done;
    last.size = tree_size(result->answer.tree);
    last.literals = literal_count(result->answer.tree);
    last.error = 1 - result->answer.agreement;
  } else {
    const bool is_stopped = result.error().code == ErrorCode::Cancelled;
    last.state = is_stopped ? PartProgress::State::Stopped : PartProgress::State::Failed;
    last.reason = result.error().message;
  }
  tell(last);
}

void PartReport::tell(const PartProgress& progress) const {
  if (board_) board_->update(progress);
}

}  // namespace hewn
