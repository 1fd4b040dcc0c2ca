#include "core/segment/tangent_planes.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

namespace hewn {
namespace {

/// The planes of `count` facets of a regular tessellation, `step_rad` apart, each cut differently.
std::vector<TangentPlane> cut_planes(const Surface& s, int count, double step_rad) {
  const Tangents t = tangents(s.axis);
  const double half_angle = std::atan(std::tan(s.half_angle_rad) * std::cos(step_rad / 2));
  std::vector<TangentPlane> planes;
  for (int k = 0; k < count; ++k) {
    const double angle = step_rad * k;
    const Vec3 outward = std::cos(angle) * t.u + std::sin(angle) * t.w;
    const double height = 3 + 0.3 * (k % 4);
    const double radius = s.kind == SurfaceKind::Cylinder ? s.radius * std::cos(step_rad / 2)
                                                          : height * std::tan(half_angle);
    TangentPlane plane;
    plane.normal = std::cos(half_angle) * outward - std::sin(half_angle) * s.axis;
    plane.point = s.point + height * s.axis + radius * outward;
    plane.point += 0.01 * (k % 3) * s.axis.cross(outward);
    plane.weight = 1 + k % 5;
    plane.reach = 2;
    planes.push_back(plane);
  }
  return planes;
}

Surface example(SurfaceKind kind) {
  Surface s;
  s.kind = kind;
  s.axis = Vec3(1, 2, -1).normalized();
  s.point = Vec3(4, -7, 2);
  if (kind == SurfaceKind::Cylinder) s.radius = 2.5;
  if (kind == SurfaceKind::Cone) s.half_angle_rad = 0.3;
  return s;
}

Surface disturbed(Surface s) {
  s.axis = (s.axis + Vec3(0.02, -0.01, 0.03)).normalized();
  s.point += Vec3(0.1, 0.05, -0.08);
  s.radius *= 1.04;
  s.half_angle_rad *= 0.95;
  return s;
}

TEST_CASE("planes tell the surface that their facets were cut from") {
  constexpr double kStep = kPi / 12;
  for (const SurfaceKind kind : {SurfaceKind::Cylinder, SurfaceKind::Cone}) {
    CAPTURE(name_of(kind));
    const Surface truth = example(kind);
    for (const int count : {6, 9, 24}) {
      CAPTURE(count);
      const auto fit = inscribed_fit(disturbed(truth), cut_planes(truth, count, kStep));
      REQUIRE(fit);
      CHECK(fit->rms_distance < 1e-12);
      const Surface s = circumscribed(fit->surface, kStep);
      CHECK(s.axis.cross(truth.axis).norm() < 1e-12);
      CHECK(s.axis.cross(s.point - truth.point).norm() < 1e-11);
      CHECK(s.radius == doctest::Approx(truth.radius));
      CHECK(s.half_angle_rad == doctest::Approx(truth.half_angle_rad));
    }
  }
}

TEST_CASE("a cone's planes miss a cylinder by as much as they lean") {
  Surface cone = example(SurfaceKind::Cone);
  cone.half_angle_rad = 0.05;
  const auto planes = cut_planes(cone, 24, kPi / 12);
  Surface near = cone;
  near.kind = SurfaceKind::Cylinder;
  near.radius = 0.1;
  const auto fit = inscribed_fit(near, planes);
  REQUIRE(fit);
  CHECK(fit->rms_distance > 0.9 * 2 * (std::sin(0.05) - std::sin(0.02)));
}

TEST_CASE("the turn of a cone's normals is less than the step about its axis") {
  const Surface cone = example(SurfaceKind::Cone);
  const auto planes = cut_planes(cone, 2, kPi / 9);
  const auto fit = inscribed_fit(cone, cut_planes(cone, 18, kPi / 9));
  REQUIRE(fit);
  const double turn = angle_between(planes[0].normal, planes[1].normal);
  CHECK(turn < kPi / 9 - 1e-3);
  CHECK(step_about_axis(fit->surface, turn) == doctest::Approx(kPi / 9));
  CHECK(step_about_axis(example(SurfaceKind::Cylinder), 0.2) == 0.2);
}

TEST_CASE("planes of other kinds, and those of a cylinder, tell no cone") {
  const Surface cylinder = example(SurfaceKind::Cylinder);
  const auto planes = cut_planes(cylinder, 12, kPi / 6);
  CHECK_FALSE(inscribed_fit(example(SurfaceKind::Cone), planes));
  CHECK_FALSE(inscribed_fit(example(SurfaceKind::Sphere), planes));
  CHECK_FALSE(inscribed_fit(cylinder, {}));
}

}  // namespace
}  // namespace hewn
