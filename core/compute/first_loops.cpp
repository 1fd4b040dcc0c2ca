#include "core/compute/first_loops.h"

#include <algorithm>
#include <atomic>
#include <chrono>

namespace hewn {
namespace {

using Clock = std::chrono::steady_clock;

/// Measured on two cores: oneTBB's libraries, memory and first thread take the caller 3.4 ms and
/// the other core 2. Two threads win as much back on loops of 7 ms; the rest is for cores that
/// other programs share.
#ifdef HEWN_SANITIZED
constexpr Clock::duration kBeginning{};  // there, loops are short and threads the point
#else
constexpr Clock::duration kBeginning = std::chrono::milliseconds(10);
#endif

std::atomic<Clock::rep> spent{0};

}  // namespace

std::size_t begin_alone(std::size_t n, std::size_t grain,
                        const std::function<void(std::size_t, std::size_t)>& body) {
  const Clock::rep before = spent.load(std::memory_order_relaxed);
  if (before >= kBeginning.count()) return 0;
  const Clock::time_point start = Clock::now();
  Clock::duration taken{};
  std::size_t done = 0;
  while (done < n && before + taken.count() < kBeginning.count()) {
    const std::size_t end = std::min(n, done + std::max<std::size_t>(grain, 1));
    body(done, end);
    done = end;
    taken = Clock::now() - start;
  }
  spent.fetch_add(taken.count(), std::memory_order_relaxed);
  return done;
}

}  // namespace hewn
