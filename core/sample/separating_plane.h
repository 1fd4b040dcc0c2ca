#pragma once
/// How separating planes are made. Internal to core/sample.
#include <vector>

#include "core/fit/surface_set.h"

namespace hewn {

/// The plane normal . x = offset along a direction of the part, which equals the unit `normal` up
/// to sign. `diagonal`: of the mesh.
inline Halfspace separating_plane(const std::vector<Vec3>& directions, int direction,
                                  const Vec3& normal, double offset, double diagonal) {
  Halfspace h;
  h.is_separating = true;
  h.tolerance = 1e-6 * diagonal;
  h.direction = direction;
  h.surface.kind = SurfaceKind::Plane;
  h.surface.axis = directions[static_cast<std::size_t>(direction)];
  h.surface.offset = h.surface.axis.dot(normal) < 0 ? -offset : offset;
  return h;
}

}  // namespace hewn
