#pragma once
/// Distances of literals that are only computed where their axis-aligned bounds do not tell enough.
#include <algorithm>

#include "core/csg/literal.h"

namespace hewn {

/// A literal's bounds, and whether it fills them: a box along the axes of space does.
struct LiteralBounds {
  Box3 box;
  double slack = 0;  ///< what the box may be off by rounding
  bool is_filled = false;

  explicit LiteralBounds(const Literal& literal);
};

/// How far `p` lies beyond the bounds' farthest side; negative inside.
inline double distance_beyond(const LiteralBounds& bounds, const Vec3& p) {
  const auto along = [&](int k) {
    return std::max(bounds.box.lo[k] - p[k], p[k] - bounds.box.hi[k]);
  };
  return std::max(std::max(along(0), along(1)), along(2));
}

/// Whether the literal holds `p`: `literal.contains(p)`.
inline bool literal_contains(const Literal& literal, const LiteralBounds& bounds, const Vec3& p) {
  const double beyond = distance_beyond(bounds, p);
  if (beyond > bounds.slack) return false;
  return (bounds.is_filled && beyond < -bounds.slack) || literal.contains(p);
}

/// The literal's signed distance, or plus or minus infinity where the bounds tell that its surface
/// is further from `p` than `reach`.
inline double distance_within(const Literal& literal, const LiteralBounds& bounds, const Vec3& p,
                              double reach) {
  const double margin = reach + bounds.slack;
  const double beyond = distance_beyond(bounds, p);
  if (beyond > margin) return kInfinity;
  return bounds.is_filled && beyond < -margin ? -kInfinity : literal.signed_distance(p);
}

}  // namespace hewn
