#include "app/hewn-studio/frame_stats.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace hewn {

void FrameStats::end(bool is_moving, bool is_busy) {
  const std::chrono::duration<double, std::milli> took = Clock::now() - start_;
  all_.ms.push_back(took.count());
  if (is_moving) moving_.ms.push_back(took.count());
  if (is_busy) busy_.ms.push_back(took.count());
}

std::string FrameStats::Frames::text() const {
  if (ms.empty()) return "{\"frames\": 0}";
  std::vector<double> sorted = ms;
  std::sort(sorted.begin(), sorted.end());
  const double mean =
      std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size());
  return fmt::format(R"({{"frames": {}, "mean_ms": {:.2f}, "p95_ms": {:.2f}, "max_ms": {:.2f}}})",
                     sorted.size(), mean, sorted[sorted.size() * 95 / 100], sorted.back());
}

std::string FrameStats::summary() const {
  return fmt::format(R"({{"all": {}, "orbiting": {}, "while_jobs_run": {}}})", all_.text(),
                     moving_.text(), busy_.text());
}

}  // namespace hewn
