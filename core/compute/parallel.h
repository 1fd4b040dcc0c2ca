#pragma once
/// Data-parallel loops on oneTBB. Results never depend on the number of threads as long as each
/// index writes only its own outputs.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>

#include "core/compute/first_loops.h"

namespace hewn {

/// Calls `body(begin, end)` on disjoint ranges that cover [0, n), each at most `grain` long,
/// on up to `threads` threads (0: one per core). Returns when all are done; the first exception
/// thrown by a body is rethrown.
void for_each_chunk(int threads, std::size_t n, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body);

/// Calls `kernel(i)` for every i in [0, n); for bodies of a microsecond or more.
template <class Kernel>
void for_each_index(int threads, std::size_t n, const Kernel& kernel, std::size_t grain = 1) {
  for_each_chunk(threads, n, grain, [&kernel](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) kernel(i);
  });
}

/// How many threads `threads` (0: one per core) stands for; at least 1.
int worker_count(int threads);

/// Calls `body(worker, i)` for every i in [0, n) in about ascending order, for bodies with scratch
/// memory of their own: no two calls with the same worker, 0 to `workers` - 1, run at a time.
template <class Body>
void for_each_with_worker(int threads, std::size_t workers, std::size_t n, const Body& body) {
  const auto alone = [&body](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(std::size_t{0}, i);
  };
  if (workers <= 1 || n <= 1) return alone(0, n);
  std::atomic<std::size_t> next{begin_alone(n, 1, alone)};
  for_each_index(threads, std::min(workers, n - next), [&](std::size_t worker) {
    for (std::size_t i = next++; i < n; i = next++) body(worker, i);
  });
}

}  // namespace hewn
