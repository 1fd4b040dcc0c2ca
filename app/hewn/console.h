#pragma once
/// What the user sees on the terminal: one line of progress, warnings, errors.
#include <chrono>
#include <mutex>
#include <string>

#include "core/base/run_context.h"

namespace hewn {

/// Writes to stderr. Thread-safe. The progress line appears on a terminal only.
class Console {
 public:
  explicit Console(bool is_quiet);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void progress(const char* stage, double share);
  void log(const LogEntry& entry);
  void error(const Error& error);
  /// Removes the progress line.
  void clear();

 private:
  void clear_locked();

  std::mutex mutex_;
  bool shows_progress_;
  bool is_quiet_;
  bool has_line_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_{};
  std::string stage_;  ///< that the line shows
};

}  // namespace hewn
