#include "core/compute/idle_threads.h"

#include <algorithm>

#include "core/compute/busy_threads.h"
#include "core/compute/parallel.h"
#include "core/compute/thread_pool.h"

namespace hewn {
namespace {

/// More are seldom idle at a time.
constexpr std::size_t kMostWorkers = 8;

}  // namespace

std::size_t idle_workers(int threads) {
  return std::min(static_cast<std::size_t>(worker_count(threads)), kMostWorkers);
}

void for_each_with_idle(int threads, std::size_t workers, std::size_t n,
                        const std::function<void(std::size_t, std::size_t)>& body) {
  // Begun in vain, a loop costs as much as a body or two.
  const bool is_alone = workers <= 1 || n <= 1 || BusyThread::count() >= worker_count(threads);
  if (is_alone) return for_each_with_worker(1, 1, n, body);
  const std::size_t first = begin_alone(n, 1, [&body](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(0, i);
  });
  if (first == n) return;
  const auto loop = [&] {
    for_each_with_worker(threads, workers, n - first,
                         [&](std::size_t worker, std::size_t i) { body(worker, first + i); });
  };
  thread_pool().isolate(threads, loop);
}

}  // namespace hewn
