#include "core/synth/rebuild/feature_points.h"

#include <array>
#include <cmath>
#include <optional>

#include "core/sample/near_middle.h"

namespace hewn {
namespace {

/// How far beside, as shares of the scale.
constexpr double kNearest = 0.003;
constexpr double kFarthest = 0.3;

/// A stretch of a line that is all inside the solid, or all outside.
struct LinePart {
  double from, to;
  bool is_inside;
  double length() const { return to - from; }
};

/// The one around the middle of a line of twice `reach`; nothing where it has no end.
std::optional<LinePart> stretch_around(const TreeRays& rays, const Vec3& p, const Vec3& direction,
                                       double reach, TreeRayScratch& scratch) {
  double end_before = -1;
  for (const TreeInterval& s : rays.cast(p - reach * direction, direction, scratch)) {
    if (s.leave.t <= reach) {
      end_before = s.leave.t;
      continue;
    }
    if (s.enter.t < reach) return LinePart{s.enter.t - reach, s.leave.t - reach, true};
    if (end_before < 0) return std::nullopt;
    return LinePart{end_before - reach, s.enter.t - reach, false};
  }
  return std::nullopt;
}

std::array<Vec3, 13> directions() {
  std::array<Vec3, 13> all;
  for (int k = 0; k < 13; ++k) {
    all[static_cast<std::size_t>(k)] = Vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1).normalized();
  }
  return all;
}

}  // namespace

std::vector<Vec3> points_beside(const TreeRays& rays, const Vec3& p, int count, double scale,
                                Rng& rng) {
  TreeRayScratch scratch;
  const double reach = 2 * scale;
  std::optional<LinePart> thinnest;
  Vec3 across;
  for (const Vec3& d : directions()) {
    const auto s = stretch_around(rays, p, d, reach, scratch);
    if (!s || (thinnest && s->length() >= thinnest->length())) continue;
    thinnest = s;
    across = d;
  }
  std::vector<Vec3> points;
  if (!thinnest) return points;
  for (int i = 0; i < count; ++i) {
    Vec3 aside(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    aside -= aside.dot(across) * across;
    if (aside.norm() < 1e-3) continue;
    const double away = scale * kNearest * std::pow(kFarthest / kNearest, rng.uniform());
    const Vec3 q = p + away * aside.normalized();
    const auto s = stretch_around(rays, q, across, reach, scratch);
    if (!s || s->is_inside != thinnest->is_inside) continue;
    points.push_back(q + near_middle(s->from, s->to) * across);
  }
  return points;
}

}  // namespace hewn
