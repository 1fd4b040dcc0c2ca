#include "core/compute/parallel.h"

#include <algorithm>
#include <thread>

#include <sched.h>

#include "core/compute/busy_threads.h"
#include "core/compute/first_loops.h"
#include "core/compute/fork_join.h"
#include "core/compute/thread_pool.h"

namespace hewn {
namespace {

/// Those that this process may use, as oneTBB counts them; it would have to be loaded to tell.
int available_cores() {
  cpu_set_t cores;
  if (::sched_getaffinity(0, sizeof(cores), &cores) == 0) return CPU_COUNT(&cores);
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace

void for_each_chunk(int threads, std::size_t n, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  if (threads == 1 || n <= grain) {
    for (std::size_t begin = 0; begin < n; begin += grain) body(begin, std::min(n, begin + grain));
    return;
  }
  const std::size_t first = begin_alone(n, grain, body);
  if (first == n) return;
  ForkJoin order;
  const auto visit = [&](std::size_t begin, std::size_t end) {
    const BusyThread busy;
    order.begin();
    body(begin, end);
    order.end();
  };
  order.fork();
  thread_pool().for_each_range(threads, first, n, grain, visit);
  order.join();
}

int worker_count(int threads) {
  if (threads == 1) return 1;
  static const int cores = available_cores();
  return threads <= 0 ? cores : std::min(threads, cores);
}

}  // namespace hewn
