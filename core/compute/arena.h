#pragma once
/// Where loops find their threads. Included by the loops alone.
#include <algorithm>

#include <tbb/info.h>
#include <tbb/task_arena.h>

namespace hewn {

/// Calls `body` such that at most `threads` threads (0: one per core) share the loops in it. Loops
/// within loops stay with the threads of the outer one: an arena of their own would cost them more
/// than most of them take.
template <class Body>
void in_arena(int threads, const Body& body) {
  if (threads <= 0 || tbb::this_task_arena::max_concurrency() <= threads) {
    body();
    return;
  }
  // More workers than cores only make the library print a warning.
  tbb::task_arena arena(std::min(threads, tbb::info::default_concurrency()));
  arena.execute(body);
}

}  // namespace hewn
