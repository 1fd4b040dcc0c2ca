#pragma once
/// A segmentation made from surfaces that a test knows.
#include "core/segment/measure_group.h"

namespace hewn {

/// Gives each triangle to the first surface that its corners and its normal fit, else to none.
inline Segmentation segment_by_surfaces(const Mesh& mesh, const std::vector<Surface>& surfaces) {
  Segmentation segmentation;
  segmentation.groups.resize(surfaces.size());
  segmentation.group_of_triangle.assign(mesh.triangles.size(), -1);
  for (std::size_t g = 0; g < surfaces.size(); ++g) segmentation.groups[g].surface = surfaces[g];
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (std::size_t g = 0; g < surfaces.size(); ++g) {
      const Surface& s = surfaces[g];
      bool fits = std::abs(s.gradient(mesh.centroid(t)).dot(mesh.normals[t])) > 0.9;
      for (int k = 0; k < 3; ++k) {
        fits = fits && std::abs(s.signed_distance(mesh.corner(t, k))) < 1e-9;
      }
      if (!fits) continue;
      segmentation.group_of_triangle[t] = static_cast<int>(g);
      segmentation.groups[g].triangles.push_back(t);
      break;
    }
  }
  for (FaceGroup& group : segmentation.groups) measure_group(mesh, group);
  return segmentation;
}

inline Surface plane(const Vec3& normal, double offset) {
  Surface s;
  s.axis = normal;
  s.offset = offset;
  return s;
}

inline Surface cylinder_surface(const Vec3& point, const Vec3& axis, double radius) {
  Surface s;
  s.kind = SurfaceKind::Cylinder;
  s.point = point;
  s.axis = axis;
  s.radius = radius;
  return s;
}

/// The six sides of the box [lo, hi]: -x, +x, -y, +y, -z, +z.
inline std::vector<Surface> box_sides(const Vec3& lo, const Vec3& hi) {
  std::vector<Surface> sides;
  for (int k = 0; k < 3; ++k) {
    sides.push_back(plane(-Vec3::Unit(k), -lo[k]));
    sides.push_back(plane(Vec3::Unit(k), hi[k]));
  }
  return sides;
}

}  // namespace hewn
