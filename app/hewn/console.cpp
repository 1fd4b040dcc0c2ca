#include "app/hewn/console.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace hewn {

Console::Console(bool is_quiet)
    : shows_progress_(!is_quiet && ::isatty(STDERR_FILENO) != 0), is_quiet_(is_quiet) {}

Console::~Console() { clear(); }

void Console::progress(const char* stage, double share) {
  if (!shows_progress_) return;
  using std::chrono::steady_clock;
  const auto now = steady_clock::now();
  const std::lock_guard lock(mutex_);
  if (now - last_ < std::chrono::milliseconds(50)) return;
  last_ = now;
  const std::chrono::duration<double> elapsed = now - start_;
  const double percent = 100 * std::clamp(share, 0.0, 1.0);
  fmt::print(stderr, "\r\033[K{:<12} {:3.0f} %  {:.1f} s", stage, percent, elapsed.count());
  std::fflush(stderr);
  has_line_ = true;
}

void Console::log(const LogEntry& entry) {
  if (is_quiet_ || entry.severity == Severity::Info) return;
  const std::lock_guard lock(mutex_);
  clear_locked();
  const char* kind = entry.severity == Severity::Error ? "error" : "warning";
  fmt::print(stderr, "hewn: {}: {}\n", kind, entry.message);
}

void Console::error(const Error& error) {
  const std::lock_guard lock(mutex_);
  clear_locked();
  if (error.where.empty()) {
    fmt::print(stderr, "hewn: error: {}\n", error.message);
  } else {
    fmt::print(stderr, "hewn: error: {}: {}\n", error.where, error.message);
  }
}

void Console::clear() {
  const std::lock_guard lock(mutex_);
  clear_locked();
}

void Console::clear_locked() {
  if (!has_line_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  has_line_ = false;
}

}  // namespace hewn
