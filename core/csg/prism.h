#pragma once
/// Regular prisms (`SolidKind::Prism`): nuts, sockets, bars. The first corner lies on the local x
/// axis, as OpenSCAD's circles begin.
#include <cmath>

#include "core/csg/literal.h"

namespace hewn {

/// More sides than this are a cylinder's facets.
inline constexpr int kMostPrismSides = 1000;

/// From the axis to a corner.
inline double circumradius(const Literal& prism) {
  return prism.radius / std::cos(kPi / prism.sides);
}
/// Corner `k` of the cross-section, counter-clockwise, on the literal's local x-y plane.
inline Vec2 prism_corner(const Literal& prism, int k) {
  const double angle_rad = 2 * kPi * k / prism.sides;
  return circumradius(prism) * Vec2(std::cos(angle_rad), std::sin(angle_rad));
}
/// Outward normal of the side from corner `k` to the next.
Vec2 prism_side_normal(const Literal& prism, int k);
/// Signed distance of a point in local coordinates, negative inside; exact.
double prism_distance(const Literal& prism, const Vec3& local);
/// The closed boundary in local coordinates.
Mesh prism_mesh(const Literal& prism);

}  // namespace hewn
