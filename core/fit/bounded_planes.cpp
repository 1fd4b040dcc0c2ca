/// Planes that no face lies on but a tree may need: the sides of oriented bounding boxes, and
/// planes that separate a part of a sphere or torus from the rest of it.
#include <algorithm>

#include "core/fit/bounded_parts.h"

namespace hewn {
namespace {

constexpr double kOrthogonal = 1e-9;

/// Three orthonormal directions for a curved group: its axis first, and of the part's own
/// directions as many as fit, so that the box is aligned with its neighbours.
Mat3 frame_of(const SurfaceSet& surfaces, const Surface& surface) {
  const Vec3 axis =
      surface.kind == SurfaceKind::Sphere
          ? (surfaces.directions.empty() ? Vec3(Vec3::UnitZ()) : surfaces.directions.front())
          : surface.axis;
  for (const Vec3& direction : surfaces.directions) {
    if (std::abs(direction.dot(axis)) > kOrthogonal) continue;
    return rotation_of(axis, direction, axis.cross(direction).normalized());
  }
  const Tangents t = tangents(axis);
  return rotation_of(axis, t.u, t.w);
}

void add_plane(const BoundedInput& input, int group, BoundedKind kind, const Vec3& normal,
               double offset, std::vector<BoundedPrimitive>& out) {
  // A plane of the part itself is there already.
  if (plane_at(planes_across(input, normal), offset, input.snap)) return;
  BoundedPrimitive primitive;
  primitive.kind = kind;
  primitive.literal = halfspace_box(input.mesh, normal, offset);
  if (!(primitive.literal.size.minCoeff() > input.snap)) return;
  primitive.groups = {group};
  out.push_back(std::move(primitive));
}

void add_bounding_box(const BoundedInput& input, int g, const Surface& surface,
                      std::vector<BoundedPrimitive>& out) {
  const Mat3 frame = frame_of(input.surfaces, surface);
  const std::vector<int>& triangles = input.segmentation.groups[g].triangles;
  for (int k = 0; k < 3; ++k) {
    const Vec3 direction = frame.col(k);
    const Interval extent = extent_along(input.mesh, triangles, direction);
    add_plane(input, g, BoundedKind::ExtraPlane, direction, extent.hi, out);
    add_plane(input, g, BoundedKind::ExtraPlane, -direction, -extent.lo, out);
  }
}

/// The plane across the group's mean outward direction that touches its innermost vertex: all of
/// the group lies before it. Halves and more have none.
void add_separating_plane(const BoundedInput& input, int g, const Surface& surface,
                          std::vector<BoundedPrimitive>& out) {
  const FaceGroup& group = input.segmentation.groups[g];
  Vec3 mean = Vec3::Zero();
  for (const int t : group.triangles) {
    mean += input.mesh.areas[t] * surface.gradient(input.mesh.centroid(t));
  }
  if (mean.norm() < 0.2 * group.area) return;
  const Vec3 normal = mean.normalized();
  const Interval extent = extent_along(input.mesh, group.triangles, normal);
  add_plane(input, g, BoundedKind::SeparatingPlane, -normal, -extent.lo, out);
}

}  // namespace

void add_extra_planes(const BoundedInput& input, std::vector<BoundedPrimitive>& out) {
  for (int g = 0; g < static_cast<int>(input.segmentation.groups.size()); ++g) {
    const int h = input.surfaces.halfspace_of_group[g];
    if (h < 0) continue;
    const Surface& surface = input.surfaces.halfspaces[h].surface;
    if (surface.kind == SurfaceKind::Plane) continue;
    add_bounding_box(input, g, surface, out);
    // Cylinders and cones have compounds instead: fewer primitives for the search.
    const bool has_compound =
        surface.kind == SurfaceKind::Cylinder || surface.kind == SurfaceKind::Cone;
    if (!has_compound) add_separating_plane(input, g, surface, out);
  }
}

}  // namespace hewn
