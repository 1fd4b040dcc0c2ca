#pragma once
/// How long the stages of an optimisation take.
#include <chrono>
#include <vector>

#include "core/synth/optimise.h"

namespace hewn {

/// Adds the time since its construction to a stage.
class StageTimer {
 public:
  StageTimer(std::vector<StageSeconds>& all, const char* stage) : all_(all), stage_(stage) {}
  ~StageTimer() {
    const std::chrono::duration<double> span = std::chrono::steady_clock::now() - start_;
    for (StageSeconds& s : all_) {
      if (s.stage != stage_) continue;
      s.seconds += span.count();
      return;
    }
    all_.push_back({stage_, span.count()});
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  std::vector<StageSeconds>& all_;
  const char* stage_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace hewn
