#include "core/session/draft_board.h"

#include <utility>

namespace hewn {

DraftBoard::DraftBoard(std::vector<bool> searched, Show show)
    : searched_(std::move(searched)), show_(std::move(show)), trees_(searched_.size()) {}

void DraftBoard::update(std::size_t partition, const Make& make) {
  std::vector<std::optional<Tree>> trees;
  {
    const std::lock_guard lock(mutex_);
    if (is_showing_ || (trees_[partition] && Clock::now() < due_)) return;
    trees_[partition] = make();
    for (std::size_t p = 0; p < searched_.size(); ++p) {
      if (searched_[p] && !trees_[p]) return;
    }
    is_showing_ = true;
    trees = trees_;
  }
  constexpr int kRest = 4;  // times what it took
  const Clock::time_point start = Clock::now();
  show_(trees);
  const Clock::time_point end = Clock::now();
  const std::lock_guard lock(mutex_);
  due_ = end + kRest * (end - start);
  is_showing_ = false;
}

}  // namespace hewn
