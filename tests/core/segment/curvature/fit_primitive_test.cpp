#include "core/segment/curvature/fit_primitive.h"

#include <doctest/doctest.h>

#include "tests/core/segment/curvature/stages.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

TEST_CASE("each class is fitted with its primitive") {
  const CurvatureOptions options;
  const Mesh ball = solids::sphere(2, 32, 16);
  const auto sphere = fit_primitive(ball, triangles_between(ball, -1.5, 1.5),
                                    CurvatureClass::Spherical, fit_limits(ball, options));
  REQUIRE(sphere.has_value());
  CHECK(sphere->kind == SurfaceKind::Sphere);
  CHECK(sphere->radius == doctest::Approx(2).epsilon(1e-9));

  const Mesh rod = solids::cylinder(1, 3, 32, 6);
  const std::vector<int> flank = triangles_between(rod, 0.1, 2.9);
  const auto cylinder = fit_primitive(rod, flank, CurvatureClass::Conic, fit_limits(rod, options));
  REQUIRE(cylinder.has_value());
  CHECK(cylinder->kind == SurfaceKind::Cylinder);
  CHECK(cylinder->radius == doctest::Approx(1).epsilon(1e-9));

  const Mesh plug = solids::cone(2, 1, 3, 32, 6);
  const auto cone = fit_primitive(plug, triangles_between(plug, 0.1, 2.9), CurvatureClass::Conic,
                                  fit_limits(plug, options));
  REQUIRE(cone.has_value());
  CHECK(cone->kind == SurfaceKind::Cone);
  CHECK(cone->half_angle_rad == doctest::Approx(std::atan2(1, 3)).epsilon(1e-9));

  const Mesh ring = solids::torus(3, 1, 48, 24);
  std::vector<int> all(ring.triangles.size());
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = static_cast<int>(t);
  const auto torus = fit_primitive(ring, all, CurvatureClass::Other, fit_limits(ring, options));
  REQUIRE(torus.has_value());
  CHECK(torus->kind == SurfaceKind::Torus);
  CHECK(torus->major_radius == doctest::Approx(3).epsilon(1e-6));
}

TEST_CASE("a fit that strays further than allowed is refused") {
  const Mesh ring = solids::torus(3, 1, 48, 24);
  const std::vector<int> band = triangles_between(ring, -0.9, 0.9);
  const FitLimits limits = fit_limits(ring, {});
  CHECK_FALSE(fit_primitive(ring, band, CurvatureClass::Planar, limits).has_value());
  CHECK(fit_primitive(ring, band, CurvatureClass::Spherical, limits)->kind == SurfaceKind::Torus);
  const Mesh egg =
      solids::transformed(solids::sphere(1, 48, 24), Affine3(Eigen::Scaling(1., 2., 3.)));
  const std::vector<int> middle = triangles_between(egg, -2, 2);
  CHECK_FALSE(
      fit_primitive(egg, middle, CurvatureClass::Spherical, fit_limits(egg, {})).has_value());
}

TEST_CASE("many regions are fitted as each of them is alone") {
  const Mesh ring = solids::torus(3, 1, 48, 24);
  const FitLimits limits = fit_limits(ring, {});
  std::vector<std::vector<int>> triangles;
  for (const double low : {-1.1, -0.9, -0.5, 0.0, 0.4}) {
    triangles.push_back(triangles_between(ring, low, 1.1));
  }
  std::vector<FitRegion> regions;
  for (const auto& of_region : triangles) {
    for (const auto curvature : {CurvatureClass::Planar, CurvatureClass::Spherical,
                                 CurvatureClass::Conic, CurvatureClass::Other}) {
      regions.push_back({of_region, curvature});
    }
  }
  const auto together = fit_primitives(ring, regions, limits, {});
  REQUIRE(together.has_value());
  REQUIRE(together->size() == regions.size());
  int fitted = 0;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    CAPTURE(i);
    const auto alone = fit_primitive(ring, regions[i].triangles, regions[i].curvature, limits);
    REQUIRE((*together)[i].has_value() == alone.has_value());
    if (!alone) continue;
    ++fitted;
    CHECK((*together)[i]->kind == alone->kind);
    CHECK((*together)[i]->radius == alone->radius);
    CHECK((*together)[i]->point == alone->point);
    CHECK((*together)[i]->axis == alone->axis);
  }
  CHECK(fitted >= 5);
  CHECK(fitted < static_cast<int>(regions.size()));
}

TEST_CASE("a triangle on a surface has no misfit, one off it grows with the distance") {
  const Mesh box = solids::box({0, 0, 0}, {1, 1, 1});
  Surface plane;
  plane.axis = box.normals[0];
  plane.offset = plane.axis.dot(box.corner(0, 0));
  const FitLimits limits = fit_limits(box, {});
  CHECK(misfit(box, 0, plane, limits) < 1e-9);
  plane.offset += limits.distance;
  CHECK(misfit(box, 0, plane, limits) == doctest::Approx(1));
}

}  // namespace
}  // namespace hewn
