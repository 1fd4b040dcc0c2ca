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

/// The literal's signed distance, or plus or minus infinity where the bounds tell that its surface
/// is further from `p` than `reach`.
inline double distance_within(const Literal& literal, const LiteralBounds& bounds, const Vec3& p,
                              double reach) {
  const double margin = reach + bounds.slack;
  double beyond = -kInfinity;
  for (int k = 0; k < 3; ++k) {
    beyond = std::max({beyond, bounds.box.lo[k] - p[k], p[k] - bounds.box.hi[k]});
    if (beyond > margin) return kInfinity;
  }
  return bounds.is_filled && beyond < -margin ? -kInfinity : literal.signed_distance(p);
}

}  // namespace hewn
