#pragma once
/// What every long call gets beside its data: cancel, progress, log, seed and worker count.
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace hewn {

class Compute;

enum class Severity { Info, Warning, Error };

struct LogEntry {
  Severity severity;
  std::string message;
  /// Tells of the machine, not of the work: no part of reports, which are the same on every one.
  bool is_about_machine = false;
};

/// Receives messages; core code never prints. Thread-safe.
using LogSink = std::function<void(const LogEntry&)>;

/// Receives the stage's name and its share done in [0, 1]. May be called from any thread, often.
using ProgressSink = std::function<void(const char* stage, double share)>;

/// A flag that one thread sets and many read. Lock-free, so that a signal handler may set it.
class CancelToken {
 public:
  /// `whole`: what this is a part of, and is cancelled with.
  explicit CancelToken(std::shared_ptr<const CancelToken> whole = {}) : whole_(std::move(whole)) {}
  void cancel() { flag_.store(true, std::memory_order_relaxed); }
  bool is_cancelled() const {
    return flag_.load(std::memory_order_relaxed) || (whole_ && whole_->is_cancelled());
  }

 private:
  std::atomic<bool> flag_{false};
  std::shared_ptr<const CancelToken> whole_;
};

/// Passed by reference through every stage. Copyable; copies share the cancel token.
struct RunContext {
  std::shared_ptr<CancelToken> cancel = std::make_shared<CancelToken>();
  ProgressSink on_progress = {};
  LogSink on_log = {};
  std::uint64_t seed = 1;
  /// Worker threads; 0 means one per core. Never changes a result.
  int threads = 0;
  /// Where kernels run (core/compute/compute.h); without it, on `threads` of the processor.
  std::shared_ptr<Compute> compute = {};
  /// An extra stop. Searches that reach it return the best answer so far; unset by default,
  /// because results then depend on the machine's speed.
  std::optional<std::chrono::steady_clock::time_point> deadline = {};

  bool is_cancelled() const { return cancel->is_cancelled(); }
  /// True when a search should return what it has: cancelled or past the deadline.
  bool should_stop() const {
    return is_cancelled() || (deadline && std::chrono::steady_clock::now() >= *deadline);
  }
  void report(const char* stage, double share) const {
    if (on_progress) on_progress(stage, share);
  }
  void warn(std::string message) const {
    if (on_log) on_log({Severity::Warning, std::move(message)});
  }
  void info(std::string message) const {
    if (on_log) on_log({Severity::Info, std::move(message)});
  }
  static Error cancelled() { return {ErrorCode::Cancelled, "stopped on request"}; }
};

}  // namespace hewn
