#include "ui/view/exact_choice.h"

#include <fmt/format.h>

namespace hewn {
namespace {

/// A full picture has four samples a pixel.
constexpr double kSamples = 4;

/// What the picture will cost, as far as is known; below 0: nothing is.
double expected_ms(bool is_rough, const ExactCost& cost) {
  if (is_rough)
    return cost.rough_ms >= 0 || cost.full_ms < 0 ? cost.rough_ms : cost.full_ms / kSamples;
  return cost.full_ms >= 0 || cost.rough_ms < 0 ? cost.full_ms : cost.rough_ms * kSamples;
}

}  // namespace

bool needs_trial(ExactMode mode, const ExactSituation& situation, const ExactCost& cost) {
  const bool is_known = cost.rough_ms >= 0 || cost.full_ms >= 0;
  return mode == ExactMode::Auto && situation.is_possible && !situation.is_hurried && !is_known;
}

bool draws_exactly(ExactMode mode, const ExactSituation& situation, const ExactCost& cost) {
  if (!situation.is_possible || mode == ExactMode::Off) return false;
  if (mode == ExactMode::On) return true;
  const double expected = expected_ms(situation.is_rough, cost);
  const double limit = situation.is_hurried ? kMovingExact_ms : kRestingExact_ms;
  return expected >= 0 && expected <= limit;
}

std::string exact_text(ExactMode mode, bool is_exact, const ExactCost& cost,
                       const std::string& problem) {
  if (!problem.empty()) return "Triangles: " + problem;
  if (mode == ExactMode::Off) return "Triangles";
  const double known = cost.full_ms >= 0 ? cost.full_ms : cost.rough_ms;
  const std::string time = known < 0 ? "" : fmt::format("{:.0f} ms", known);
  if (is_exact) return time.empty() ? "Exact" : "Exact, " + time;
  return time.empty() ? "Triangles for now" : "Triangles for now (exact: " + time + ")";
}

}  // namespace hewn
