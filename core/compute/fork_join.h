#pragma once
/// The beginning and the end of a parallel loop, as the thread sanitizer can see them: oneTBB,
/// which orders both, is not built with it. Without a sanitizer nothing is done. Included by the
/// loops alone.
#include <atomic>
#include <cstddef>

namespace hewn {

class ForkJoin {
 public:
#ifdef HEWN_SANITIZED
  /// By the caller of the loop, before and after it.
  void fork() { begun_.store(true, std::memory_order_release); }
  void join() { (void)ended_.load(std::memory_order_acquire); }
  /// By each body, first and last. Bodies stay unordered among each other.
  void begin() { (void)begun_.load(std::memory_order_acquire); }
  void end() { ended_.fetch_add(1, std::memory_order_release); }

 private:
  std::atomic<bool> begun_{false};
  std::atomic<std::size_t> ended_{0};
#else
  void fork() {}
  void join() {}
  void begin() {}
  void end() {}
#endif
};

}  // namespace hewn
