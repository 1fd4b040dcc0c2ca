#include "core/csg/surface.h"

#include <algorithm>

#include "core/compute/kernels/fit_rows.h"

namespace hewn {
namespace {

/// Height along the axis and distance from it.
struct AxisCoordinates {
  double height, radial;
  Vec3 outward;  ///< from the axis to the point; not normalised
};

AxisCoordinates about_axis(const Surface& s, const Vec3& x) {
  const Vec3 d = x - s.point;
  const double height = s.axis.dot(d);
  const Vec3 outward = d - s.axis * height;
  return {height, outward.norm(), outward};
}

template <class Fallback>
Vec3 unit_or(const Vec3& v, double length, const Fallback& fallback) {
  return length > 0 ? Vec3(v / length) : fallback();
}

}  // namespace

double Surface::signed_distance(const Vec3& x) const {
  return hewn::signed_distance(form(), x.x(), x.y(), x.z());
}

SurfaceForm Surface::form() const {
  SurfaceForm f{kind,
                {point.x(), point.y(), point.z()},
                {axis.x(), axis.y(), axis.z()},
                kind == SurfaceKind::Plane ? offset : radius,
                major_radius};
  if (kind == SurfaceKind::Cone) {
    f.first = std::cos(half_angle_rad);
    f.second = std::sin(half_angle_rad);
  }
  return f;
}

Vec3 Surface::gradient(const Vec3& x) const { return SurfaceField(*this).gradient(x); }

Vec3 SurfaceField::gradient(const Vec3& x) const {
  const Surface& s = surface_;
  if (s.kind == SurfaceKind::Plane) return s.axis;
  if (s.kind == SurfaceKind::Sphere) {
    return unit_or(x - s.point, (x - s.point).norm(), [] { return Vec3(Vec3::UnitZ()); });
  }
  const AxisCoordinates c = about_axis(s, x);
  Vec3 outward = unit_or(c.outward, c.radial, [&] { return tangents(s.axis).u; });
  if (s.kind == SurfaceKind::Cylinder) return outward;
  if (s.kind == SurfaceKind::Cone) return outward * form_.first - s.axis * form_.second;
  const Vec3 from_tube = outward * (c.radial - s.major_radius) + s.axis * c.height;
  return unit_or(from_tube, from_tube.norm(), [&] { return s.axis; });
}

const char* name_of(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::Plane:
      return "plane";
    case SurfaceKind::Sphere:
      return "sphere";
    case SurfaceKind::Cylinder:
      return "cylinder";
    case SurfaceKind::Cone:
      return "cone";
    case SurfaceKind::Torus:
      return "torus";
  }
  return "surface";
}

int parameter_count(SurfaceKind kind) { return parameters(kind); }

}  // namespace hewn
