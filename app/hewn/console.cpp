#include "app/hewn/console.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace hewn {
namespace {

/// Nobody can be told that messages have nowhere to go; the exit code still says how it went.
void put(const std::string& text) {
  [[maybe_unused]] const auto ignored = std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

Console::Console(bool is_quiet)
    : shows_progress_(!is_quiet && ::isatty(STDERR_FILENO) != 0), is_quiet_(is_quiet) {}

Console::~Console() { clear(); }

void Console::progress(const char* stage, double share) {
  if (!shows_progress_) return;
  using std::chrono::steady_clock;
  const auto now = steady_clock::now();
  const std::lock_guard lock(mutex_);
  // A new stage shows at once: it may be long and have no more to say.
  if (now - last_ < std::chrono::milliseconds(50) && stage_ == stage) return;
  last_ = now;
  stage_ = stage;
  const std::chrono::duration<double> elapsed = now - start_;
  const double percent = 100 * std::clamp(share, 0.0, 1.0);
  put(fmt::format("\r\033[K{:<12} {:3.0f} %  {:.1f} s", stage, percent, elapsed.count()));
  has_line_ = true;
}

void Console::log(const LogEntry& entry) {
  if (is_quiet_ || entry.severity == Severity::Info) return;
  const std::lock_guard lock(mutex_);
  clear_locked();
  const char* kind = entry.severity == Severity::Error ? "error" : "warning";
  put(fmt::format("hewn: {}: {}\n", kind, entry.message));
}

void Console::error(const Error& error) {
  const std::lock_guard lock(mutex_);
  clear_locked();
  if (error.where.empty()) {
    put(fmt::format("hewn: error: {}\n", error.message));
  } else {
    put(fmt::format("hewn: error: {}: {}\n", error.where, error.message));
  }
}

void Console::clear() {
  const std::lock_guard lock(mutex_);
  clear_locked();
}

void Console::clear_locked() {
  if (!has_line_) return;
  put("\r\033[K");
  has_line_ = false;
}

}  // namespace hewn
