#pragma once
/// Data-parallel loops on oneTBB. Results never depend on the number of threads as long as each
/// index writes only its own outputs.
#include <cstddef>
#include <functional>

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

}  // namespace hewn
