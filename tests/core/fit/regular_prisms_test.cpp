#include "core/fit/regular_prisms.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "core/csg/prism.h"
#include "tests/support/part_problem.h"

namespace hewn {
namespace {

/// A turned prism whose vertices are off by up to `noise`.
SurfaceSet sides_of(int sides, double radius, double noise) {
  Literal prism;
  prism.kind = SolidKind::Prism;
  prism.sides = sides;
  prism.radius = radius;
  prism.height = 3;
  prism.rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  prism.origin = Vec3(4, -1, 2);
  Mesh mesh = prism_mesh(prism);
  Rng rng(3);
  for (Vec3& p : mesh.vertices) {
    p = prism.to_world(p);
    for (double& c : p) c += noise * rng.uniform(-1, 1);
  }
  return solids::PartProblem(make_mesh(mesh.vertices, mesh.triangles)).surfaces;
}

TEST_CASE("the sides of a turned, noisy prism are flush with the ideal one") {
  for (const int sides : {5, 6, 8, 10, 12}) {
    const SurfaceSet surfaces = sides_of(sides, 1.25, 2e-5);
    const auto prisms = find_regular_prisms(surfaces);
    REQUIRE_FALSE(prisms.empty());
    const RegularPrism& prism = prisms.front();
    REQUIRE(prism.count() == sides);
    CHECK(prism.radius == doctest::Approx(1.25).epsilon(3e-5));
    for (int k = 0; k < sides; ++k) {
      const HalfspaceSide& side = prism.sides[k];
      const Surface& plane = surfaces.halfspaces[side.halfspace].surface;
      const double angle = 2 * kPi * k / sides;
      const Vec3 normal =
          prism.normal * std::cos(angle) + prism.axis.cross(prism.normal) * std::sin(angle);
      CHECK(normal.cross(plane.axis).norm() < 1e-12);
      CHECK(std::abs(plane.signed_distance(prism.center + normal * prism.radius)) < 1e-12);
    }
  }
}

TEST_CASE("sides are compared where the prism is, not at the origin") {
  const Vec3 center(60, 40, 0);
  for (int sides = 5; sides <= 14; ++sides) {
    CAPTURE(sides);
    SurfaceSet surfaces;
    for (int k = 0; k < sides; ++k) {
      const double degrees = std::round(36000.0 * k / sides) / 100;  // rounded, as angles are
      Halfspace h;
      h.surface.axis = {std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180), 0};
      h.surface.offset = h.surface.axis.dot(center) + 2;
      h.tolerance = 1e-6;
      h.direction = k;
      surfaces.directions.push_back(h.surface.axis);
      surfaces.halfspaces.push_back(h);
    }
    const auto prisms = find_regular_prisms(surfaces);
    REQUIRE_FALSE(prisms.empty());
    CHECK(prisms.front().count() == sides);
    CHECK(prisms.front().radius == doctest::Approx(2).epsilon(1e-4));
    CHECK((prisms.front().center - center).norm() < 1e-3);
  }
}

/// Pentagons of the same corner radius side by side, with sides rounded on their own.
SurfaceSet rounded_pentagons(const std::vector<Vec3>& centers, double corner_radius) {
  SurfaceSet surfaces;
  for (int k = 0; k < 5; ++k) {
    const double angle = (36 + 72 * k) * kPi / 180;
    surfaces.directions.emplace_back(std::cos(angle), std::sin(angle), 0);
    for (const Vec3& center : centers) {
      Halfspace h;
      h.surface.axis = surfaces.directions.back();
      const double exact = h.surface.axis.dot(center) + corner_radius * std::cos(kPi / 5);
      h.surface.offset = std::round(1e4 * exact) / 1e4;
      h.tolerance = 2e-4;
      h.direction = k;
      const bool is_known = std::any_of(
          surfaces.halfspaces.begin(), surfaces.halfspaces.end(),
          [&](const auto& o) { return o.direction == k && o.surface.offset == h.surface.offset; });
      if (!is_known) surfaces.halfspaces.push_back(h);
    }
  }
  return surfaces;
}

TEST_CASE("a coarse circle's corners get the round radius, side by side, too") {
  // The last side of both lies in one plane.
  const std::vector<Vec3> centers = {{7, 5, 0}, {7, 25, 0}};
  SurfaceSet surfaces = rounded_pentagons(centers, 1.5);
  REQUIRE(surfaces.halfspaces.size() == 9);
  CHECK(settle_regular_prisms(surfaces, 100, true).size() == 9);
  const auto prisms = find_regular_prisms(surfaces);
  REQUIRE(prisms.size() == 2);
  for (const RegularPrism& prism : prisms) {
    CHECK(prism.radius == doctest::Approx(1.5 * std::cos(kPi / 5)).epsilon(1e-9));
    CHECK(std::min((prism.center - centers[0]).norm(), (prism.center - centers[1]).norm()) < 1e-9);
  }
}

TEST_CASE("settling moves nothing that is flush") {
  SurfaceSet surfaces = sides_of(6, 0.75, 0);
  CHECK(settle_regular_prisms(surfaces, 10, true).empty());
  double shift = 0;
  for (Halfspace& h : surfaces.halfspaces) h.surface.offset += shift += 2e-6;
  CHECK(settle_regular_prisms(surfaces, 10, true).size() == 6);
  CHECK(settle_regular_prisms(surfaces, 10, true).empty());
}

}  // namespace
}  // namespace hewn
