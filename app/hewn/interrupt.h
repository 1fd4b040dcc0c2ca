#pragma once
/// Ctrl-C: first asks the work to stop, then ends the process, never within a file's writing.
#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

#include "core/base/run_context.h"

namespace hewn {

/// Waits for SIGINT and SIGTERM on a thread of its own while it lives. Make it before any other
/// thread starts: it blocks the signals in the calling thread, and threads inherit that.
class Interrupt {
 public:
  explicit Interrupt(std::shared_ptr<CancelToken> cancel);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Hold this while a file is written: the process then ends before or after, not between.
  std::mutex& publishing() { return publishing_; }

 private:
  void wait_for_signals();

  std::shared_ptr<CancelToken> cancel_;
  std::mutex publishing_;
  std::atomic<bool> is_ending_{false};
  std::thread thread_;
};

}  // namespace hewn
