/// The loops of parallel.h without oneTBB, for GPU machines that do not have it.
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "core/compute/parallel.h"

namespace hewn {

void for_each_chunk(int threads, std::size_t n, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  const std::size_t chunks = (n + grain - 1) / grain;
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  const auto most = threads <= 0 ? std::size_t{cores} : static_cast<std::size_t>(threads);
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    try {
      for (std::size_t c = next++; c < chunks; c = next++) {
        body(c * grain, std::min(n, (c + 1) * grain));
      }
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next = chunks;
    }
  };
  std::vector<std::thread> helpers;
  for (std::size_t t = 1; t < std::min(most, chunks); ++t) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
  if (failure) std::rethrow_exception(failure);
}

int worker_count(int threads) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return threads <= 0 ? cores : std::min(threads, cores);
}

}  // namespace hewn
