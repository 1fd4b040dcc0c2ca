#include "core/csg/prism.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace hewn {
namespace {

Vec2 unit(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

/// In the cross-section: every sector is turned onto the side whose normal is the x axis.
double polygon_distance(const Literal& s, const Vec2& p) {
  const double sector = 2 * kPi / s.sides;
  const double angle = std::remainder(std::atan2(p.y(), p.x()) - sector / 2, sector);
  const Vec2 folded = p.norm() * unit(angle);
  const double beyond_side = folded.x() - s.radius;
  const double beyond_corner = std::abs(folded.y()) - s.radius * std::tan(sector / 2);
  return beyond_side > 0 && beyond_corner > 0 ? std::hypot(beyond_side, beyond_corner)
                                              : beyond_side;
}

}  // namespace

Vec2 prism_side_normal(const Literal& prism, int k) {
  return unit(kPi * (2 * k + 1) / prism.sides);
}

double prism_distance(const Literal& prism, const Vec3& local) {
  const double across = polygon_distance(prism, local.head<2>());
  const double along = std::max(-local.z(), local.z() - prism.height);
  const double beyond = std::hypot(std::max(across, 0.0), std::max(along, 0.0));
  return beyond + std::min(std::max(across, along), 0.0);
}

Mesh prism_mesh(const Literal& prism) {
  const int n = prism.sides;
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (const double z : {0.0, prism.height}) {
    for (int k = 0; k < n; ++k) {
      const Vec2 corner = prism_corner(prism, k);
      vertices.emplace_back(corner.x(), corner.y(), z);
    }
  }
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    triangles.push_back({k, next, n + k});
    triangles.push_back({next, n + next, n + k});
    if (k == 0 || next == 0) continue;
    triangles.push_back({0, next, k});
    triangles.push_back({n, n + k, n + next});
  }
  return make_mesh(std::move(vertices), std::move(triangles));
}

}  // namespace hewn
