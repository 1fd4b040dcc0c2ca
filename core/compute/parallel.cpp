#include "core/compute/parallel.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace hewn {

void for_each_chunk(int threads, std::size_t n, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  if (threads == 1 || n <= grain) {
    for (std::size_t begin = 0; begin < n; begin += grain) body(begin, std::min(n, begin + grain));
    return;
  }
  const tbb::blocked_range<std::size_t> range(0, n, grain);
  const auto run = [&] {
    tbb::parallel_for(
        range, [&](const tbb::blocked_range<std::size_t>& part) { body(part.begin(), part.end()); },
        tbb::simple_partitioner());
  };
  if (threads <= 0) {
    run();
  } else {
    // More workers than cores only make the library print a warning.
    tbb::task_arena arena(std::min(threads, tbb::info::default_concurrency()));
    arena.execute(run);
  }
}

int worker_count(int threads) {
  const int cores = std::max(1, tbb::info::default_concurrency());
  return threads <= 0 ? cores : std::min(threads, cores);
}

}  // namespace hewn
