#include "app/hewn-studio/frame_stats.h"

#include <algorithm>
#include <ctime>
#include <numeric>

#include <fmt/format.h>

namespace hewn {
namespace {

/// Of all threads of the process, or of the thread that asks.
double cpu_now_ms(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

void FrameStats::begin() {
  start_ = Clock::now();
  cpu_start_ms_ = cpu_now_ms(CLOCK_PROCESS_CPUTIME_ID);
  own_start_ms_ = cpu_now_ms(CLOCK_THREAD_CPUTIME_ID);
}

void FrameStats::end(bool is_moving, bool is_busy) {
  const std::chrono::duration<double, std::milli> took = Clock::now() - start_;
  const double cpu_ms = cpu_now_ms(CLOCK_PROCESS_CPUTIME_ID) - cpu_start_ms_;
  const double own_ms = cpu_now_ms(CLOCK_THREAD_CPUTIME_ID) - own_start_ms_;
  const auto add = [&](Frames& frames) {
    frames.ms.push_back(took.count());
    frames.cpu_ms.push_back(cpu_ms);
    frames.own_ms.push_back(own_ms);
  };
  add(all_);
  if (is_moving) add(moving_);
  if (is_busy) add(busy_);
}

std::string FrameStats::Frames::text() const {
  if (ms.empty()) return "{\"frames\": 0}";
  std::vector<double> sorted = ms;
  std::sort(sorted.begin(), sorted.end());
  return fmt::format(
      R"({{"frames": {}, "mean_ms": {:.2f}, "median_ms": {:.2f}, "p95_ms": {:.2f}, "max_ms": {:.2f}, "cpu_ms": {:.2f}, "own_max_ms": {:.2f}}})",
      sorted.size(), mean(ms), sorted[sorted.size() / 2], sorted[sorted.size() * 95 / 100],
      sorted.back(), mean(cpu_ms), *std::max_element(own_ms.begin(), own_ms.end()));
}

std::string FrameStats::summary() const {
  return fmt::format(R"({{"all": {}, "orbiting": {}, "while_jobs_run": {}}})", all_.text(),
                     moving_.text(), busy_.text());
}

}  // namespace hewn
