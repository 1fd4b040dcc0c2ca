#pragma once
/// Axes of cylinders and cones, compared as lines.
#include <algorithm>
#include <vector>

#include "core/csg/surface.h"

namespace hewn {

/// Whether straight lines run along the surface in the plane of its axis.
inline bool is_ruled(SurfaceKind kind) {
  return kind == SurfaceKind::Cylinder || kind == SurfaceKind::Cone;
}

/// Whether the surface's axis is that of one of the others, whose points lie within `near` of it.
inline bool has_same_axis(const std::vector<Surface>& others, const Surface& s, double near) {
  constexpr double kParallel = 1e-4;  // sine
  return std::any_of(others.begin(), others.end(), [&](const Surface& other) {
    return other.axis.cross(s.axis).norm() < kParallel &&
           other.axis.cross(s.point - other.point).norm() < near;
  });
}

}  // namespace hewn
