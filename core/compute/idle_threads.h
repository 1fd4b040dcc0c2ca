#pragma once
/// Short loops in the bodies of long ones, shared with threads that have run out of work.
#include <cstddef>
#include <functional>

namespace hewn {

/// How many scratch memories a loop by `for_each_with_idle` on `threads` (0: one per core) can use.
std::size_t idle_workers(int threads);

/// Calls `body(worker, i)` for every i in [0, n) in about ascending order; no two calls with the
/// same worker, 0 to `workers` - 1, run at a time. Threads of the loop around this call
/// (`for_each_index`) that have run out of work join in. Whoever waits for them begins nothing else
/// in the meantime, which might take long. Meant for bodies of 10 us or more.
/// Requires: `workers` <= `idle_workers(threads)`.
void for_each_with_idle(int threads, std::size_t workers, std::size_t n,
                        const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace hewn
