#include "core/compute/parallel.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/compute/arena.h"
#include "core/compute/busy_threads.h"
#include "core/compute/first_loops.h"
#include "core/compute/fork_join.h"

namespace hewn {

void for_each_chunk(int threads, std::size_t n, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  if (threads == 1 || n <= grain) {
    for (std::size_t begin = 0; begin < n; begin += grain) body(begin, std::min(n, begin + grain));
    return;
  }
  const std::size_t first = begin_alone(n, grain, body);
  if (first == n) return;
  const tbb::blocked_range<std::size_t> range(first, n, grain);
  ForkJoin order;
  const auto visit = [&](const tbb::blocked_range<std::size_t>& part) {
    const BusyThread busy;
    order.begin();
    body(part.begin(), part.end());
    order.end();
  };
  order.fork();
  in_arena(threads, [&] { tbb::parallel_for(range, visit, tbb::simple_partitioner()); });
  order.join();
}

int worker_count(int threads) {
  if (threads == 1) return 1;  // oneTBB looks for other libraries before it knows the cores
  const int cores = std::max(1, tbb::info::default_concurrency());
  return threads <= 0 ? cores : std::min(threads, cores);
}

}  // namespace hewn
