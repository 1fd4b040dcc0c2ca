#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/compute/thread_pool.h"

namespace hewn {
namespace {

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

void for_each_range(int threads, std::size_t begin, std::size_t end, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body) {
  using Range = tbb::blocked_range<std::size_t>;
  const auto visit = [&body](const Range& part) { body(part.begin(), part.end()); };
  in_arena(threads,
           [&] { tbb::parallel_for(Range(begin, end, grain), visit, tbb::simple_partitioner()); });
}

void isolate(int threads, const std::function<void()>& loop) {
  in_arena(threads, [&loop] { tbb::this_task_arena::isolate(loop); });
}

}  // namespace
}  // namespace hewn

/// What `thread_pool` looks up.
extern "C" __attribute__((visibility("default"))) const hewn::ThreadPool* hewn_thread_pool() {
  static constexpr hewn::ThreadPool kPool{hewn::for_each_range, hewn::isolate};
  return &kPool;
}
