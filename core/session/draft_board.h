#pragma once
/// Trees found on the way, to look at while the search goes on.
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "core/csg/tree.h"

namespace hewn {

/// The latest tree of every partition. Thread-safe. What it shows depends on the clock: nothing
/// that is kept may depend on it.
class DraftBoard {
 public:
  /// Gets one tree for each partition that is searched; runs on the thread that brought the last.
  using Show = std::function<void(const std::vector<std::optional<Tree>>& trees)>;
  using Make = std::function<Tree()>;

  /// `searched`: for each partition, whether it will get a tree.
  DraftBoard(std::vector<bool> searched, Show show);

  /// A better tree for a partition, made only when it is wanted. Shows all when there is one for
  /// every partition, no other thread is showing, and showing takes no more than a fifth of the
  /// time.
  void update(std::size_t partition, const Make& make);

 private:
  using Clock = std::chrono::steady_clock;

  std::vector<bool> searched_;
  Show show_;
  std::mutex mutex_;
  std::vector<std::optional<Tree>> trees_;
  bool is_showing_ = false;
  Clock::time_point due_{};
};

}  // namespace hewn
