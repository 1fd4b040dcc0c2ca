#include "core/csg/flat_end.h"

#include <algorithm>
#include <cmath>

#include "core/csg/prism.h"

namespace hewn {
namespace {

double radius_at(const Literal& s, double z) {
  return s.radius + (s.top_radius - s.radius) * z / s.height;
}

/// Of the literal in its local coordinates; flanks as wide as the wider end.
LocalBox local_box(const Literal& s) {
  if (s.kind == SolidKind::Box) return {Vec3::Zero(), s.size};
  const double r = s.kind == SolidKind::Prism ? circumradius(s) : std::max(s.radius, s.top_radius);
  return {Vec3(-r, -r, 0), Vec3(r, r, s.height)};
}

}  // namespace

std::vector<FlatEnd> flat_ends(const Literal& literal) {
  std::vector<FlatEnd> ends;
  const bool is_box = literal.kind == SolidKind::Box;
  const bool is_upright = literal.kind == SolidKind::Cylinder || literal.kind == SolidKind::Prism;
  if (literal.stretch || (!is_box && !is_upright)) return ends;
  for (int axis = is_box ? 0 : 2; axis < 3; ++axis) {
    for (const bool is_upper : {false, true}) ends.push_back({axis, is_upper});
  }
  return ends;
}

Vec3 outward_normal(const Literal& literal, FlatEnd end) {
  return end.is_upper ? Vec3(literal.rotation.col(end.axis))
                      : Vec3(-literal.rotation.col(end.axis));
}

double plane_offset(const Literal& literal, FlatEnd end) {
  const double length = literal.kind == SolidKind::Box ? literal.size[end.axis] : literal.height;
  const double base = literal.origin[end.axis];
  return end.is_upper ? base + length : -base;
}

Literal with_moved_end(Literal s, FlatEnd end, double amount) {
  if (s.kind == SolidKind::Box) {
    s.size[end.axis] += amount;
  } else if (s.kind == SolidKind::Prism) {
    s.height += amount;
  } else {
    const double slope = (s.top_radius - s.radius) / s.height;
    if (end.is_upper) s.top_radius += slope * amount;
    if (!end.is_upper) s.radius -= slope * amount;
    s.height += amount;
  }
  if (!end.is_upper) s.origin[end.axis] -= amount;
  return s;
}

bool is_valid_flat(const Literal& s) {
  if (s.kind == SolidKind::Box) return s.size.minCoeff() > 0;
  return s.height > 0 && s.radius >= 0 && s.top_radius >= 0;
}

LocalBox beyond_end(const Literal& literal, FlatEnd end, double from, double to) {
  LocalBox box = local_box(literal);
  const double face = end.is_upper ? box.hi[end.axis] : box.lo[end.axis];
  const double sign = end.is_upper ? 1 : -1;
  box.lo[end.axis] = std::min(face + sign * from, face + sign * to);
  box.hi[end.axis] = std::max(face + sign * from, face + sign * to);
  return box;
}

bool is_over_end(const Literal& s, FlatEnd end, const Vec3& local, double margin) {
  if (s.kind == SolidKind::Box) {
    for (int c = 0; c < 3; ++c) {
      if (c != end.axis && (local[c] < -margin || local[c] > s.size[c] + margin)) return false;
    }
    return true;
  }
  if (s.kind == SolidKind::Prism) {
    return prism_distance(s, Vec3(local.x(), local.y(), s.height / 2)) < margin;
  }
  const double r = std::max(end.is_upper ? s.top_radius : s.radius, radius_at(s, local.z()));
  return std::hypot(local.x(), local.y()) < r + margin;
}

}  // namespace hewn
