#pragma once
/// How many threads are in the bodies of parallel loops. Included by the loops alone.
#include <atomic>

namespace hewn {

/// Counts its thread for as long as it lives, once however many of them the thread holds.
class BusyThread {
 public:
  BusyThread() {
    if (depth++ == 0) busy.fetch_add(1, std::memory_order_relaxed);
  }
  ~BusyThread() {
    if (--depth == 0) busy.fetch_sub(1, std::memory_order_relaxed);
  }
  BusyThread(const BusyThread&) = delete;
  BusyThread& operator=(const BusyThread&) = delete;

  /// Of all loops; already another number when it is read, so that only speed may depend on it.
  static int count() { return busy.load(std::memory_order_relaxed); }

 private:
  static inline std::atomic<int> busy{0};
  static inline thread_local int depth = 0;
};

}  // namespace hewn
