#pragma once
/// Distances from unbounded surfaces, in plain numbers, so that host and device give the same bits.
#include <cmath>

#include "core/compute/host_device.h"

namespace hewn {

enum class SurfaceKind { Plane, Sphere, Cylinder, Cone, Torus };

/// What evaluation needs of a surface (core/csg/surface.h has the fields' meaning).
struct SurfaceForm {
  SurfaceKind kind = SurfaceKind::Plane;
  double point[3] = {0, 0, 0};
  double axis[3] = {0, 0, 1};
  double first = 0;   ///< plane: offset; sphere, cylinder, torus: radius; cone: cosine
  double second = 0;  ///< cone: sine of the half angle; torus: major radius
};

/// a . b from left to right, as in Eigen: other orders round differently.
HEWN_HD double dot3(const double* a, double x, double y, double z) {
  return a[0] * x + a[1] * y + a[2] * z;
}
HEWN_HD double norm3(double x, double y, double z) { return sqrt(x * x + y * y + z * z); }

/// Signed distance from a surface of a known kind, negative inside. Cost: at most 24 operations and
/// two square roots.
template <SurfaceKind kKind>
HEWN_HD double signed_distance(const SurfaceForm& s, double x, double y, double z) {
  if constexpr (kKind == SurfaceKind::Plane) {
    return dot3(s.axis, x, y, z) - s.first;
  } else {
    const double dx = x - s.point[0];
    const double dy = y - s.point[1];
    const double dz = z - s.point[2];
    if constexpr (kKind == SurfaceKind::Sphere) {
      return norm3(dx, dy, dz) - s.first;
    } else {
      const double height = dot3(s.axis, dx, dy, dz);
      const double radial = norm3(dx - s.axis[0] * height, dy - s.axis[1] * height,  //
                                  dz - s.axis[2] * height);
      if constexpr (kKind == SurfaceKind::Cylinder) {
        return radial - s.first;
      } else if constexpr (kKind == SurfaceKind::Cone) {
        return radial * s.first - height * s.second;
      } else {
        const double across = radial - s.second;
        return sqrt(across * across + height * height) - s.first;
      }
    }
  }
}

HEWN_HD double signed_distance(const SurfaceForm& s, double x, double y, double z) {
  switch (s.kind) {
    case SurfaceKind::Plane:
      return signed_distance<SurfaceKind::Plane>(s, x, y, z);
    case SurfaceKind::Sphere:
      return signed_distance<SurfaceKind::Sphere>(s, x, y, z);
    case SurfaceKind::Cylinder:
      return signed_distance<SurfaceKind::Cylinder>(s, x, y, z);
    case SurfaceKind::Cone:
      return signed_distance<SurfaceKind::Cone>(s, x, y, z);
    case SurfaceKind::Torus:
      return signed_distance<SurfaceKind::Torus>(s, x, y, z);
  }
  return 0;
}

}  // namespace hewn
