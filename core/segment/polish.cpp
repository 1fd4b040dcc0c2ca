#include "core/segment/polish.h"

#include <algorithm>

#include "core/fit/gauss_newton.h"

namespace hewn {
namespace {

constexpr std::size_t kMaxPoints = 2000;
constexpr int kRounds = 14;
constexpr double kShrink = 0.55;
constexpr double kRounding = 1e-7;  // share of the diagonal

FitSettings exact_settings() {
  FitSettings settings;
  settings.max_iterations = 6;
  settings.min_decrease = 1e-9;
  return settings;
}

std::vector<Vec3> thinned(std::span<const Vec3> points) {
  if (points.size() <= kMaxPoints) return {points.begin(), points.end()};
  std::vector<Vec3> picked;
  for (std::size_t i = 0; i < kMaxPoints; ++i) {
    picked.push_back(points[i * points.size() / kMaxPoints]);
  }
  return picked;
}

/// The points within `share` of the spread below the outermost ones (at least `min_band`).
std::vector<Vec3> outer_points(const Surface& s, std::span<const Vec3> points, double share,
                               double min_band) {
  std::vector<double> distance;
  for (const Vec3& p : points) distance.push_back(s.signed_distance(p));
  std::vector<double> sorted = distance;
  std::sort(sorted.begin(), sorted.end());
  // The very outermost may be outliers.
  const double outermost =
      sorted[static_cast<std::size_t>(static_cast<double>(sorted.size() - 1) * 0.99)];
  const double band = std::max(min_band, share * (outermost - sorted.front()));
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(distance[i] - outermost) < band) kept.push_back(points[i]);
  }
  return kept;
}

}  // namespace

void polish_on_envelope(Surface& surface, std::span<const Vec3> corners,
                        const SurfaceTolerance& tolerance) {
  if (corners.empty()) return;
  // No curved group told the noise when it is this small: allow for rounded digits.
  const double noise = std::max(tolerance.noise, kRounding * tolerance.diagonal);
  const double exact = 1.5 * noise;
  const double before = rms_distance(surface, corners);
  if (before < exact) {
    const std::vector<Vec3> points = thinned(corners);
    Surface s = surface;
    if (refine_surface(s, {points}, exact_settings()) && rms_distance(s, corners) < before) {
      surface = s;
    }
    return;
  }
  const double min_band = 5 * noise;
  const std::size_t share_needed = tolerance.is_resampled ? 50 : 8;
  const std::size_t enough = std::max<std::size_t>(
      2 * static_cast<std::size_t>(parameter_count(surface.kind)), corners.size() / share_needed);
  Surface s = surface;
  std::vector<Vec3> kept;
  double share = 0.5;
  for (int round = 0; round < kRounds; ++round, share *= kShrink) {
    kept = outer_points(s, corners, share, min_band);
    if (kept.size() < enough) return;
    if (!refine_surface(s, {thinned(kept)}, exact_settings())) return;
  }
  if (rms_distance(s, kept) < 4 * noise) surface = s;
}

}  // namespace hewn
