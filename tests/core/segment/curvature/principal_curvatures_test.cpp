#include <doctest/doctest.h>

#include "tests/core/segment/curvature/stages.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

CurvatureOptions angle_weights() {
  CurvatureOptions options;
  options.normal_weights = static_cast<int>(NormalWeights::Angle);
  return options;
}

TEST_CASE("a sphere has both curvatures 1/r away from its poles") {
  const Mesh mesh = solids::sphere(2, 96, 48);
  const CurvatureStages s = run_stages(mesh, angle_weights());
  const auto middle = triangles_between(mesh, -1.6, 1.6);
  REQUIRE(middle.size() > 1000);
  for (const int t : middle) {
    CHECK(s.curvatures[t].max == doctest::Approx(0.5).epsilon(0.02));
    CHECK(s.curvatures[t].min == doctest::Approx(0.5).epsilon(0.02));
  }
}

TEST_CASE("a cylinder's flank is curved across its axis only, up to its sharp rims") {
  const Mesh mesh = solids::transformed(solids::cylinder(2, 5, 64, 6), solids::oblique_transform());
  const Vec3 axis = solids::oblique_transform().rotation() * Vec3::UnitZ();
  const CurvatureStages s = run_stages(mesh, angle_weights());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (std::abs(mesh.normals[t].dot(axis)) > 0.5) {
      CHECK(std::abs(s.curvatures[t].max) < 1e-10);
    } else {
      CHECK(s.curvatures[t].max == doctest::Approx(0.5).epsilon(0.01));
      CHECK(std::abs(s.curvatures[t].min) < 1e-10);
      CHECK(std::abs(s.curvatures[t].max_direction.dot(axis)) < 1e-6);
    }
  }
}

TEST_CASE("the wall of a hole is curved the other way") {
  const Mesh mesh = solids::plate_with_hole({8, 8, 2}, 2, 64, 3);
  const CurvatureStages s = run_stages(mesh, angle_weights());
  int on_wall = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 c = mesh.centroid(static_cast<int>(t));
    if (c.head<2>().norm() > 2.01 || std::abs(mesh.normals[t].z()) > 0.5) continue;
    CHECK(s.curvatures[t].max == doctest::Approx(-0.5).epsilon(0.01));
    ++on_wall;
  }
  CHECK(on_wall == 64 * 2 * 3);
}

TEST_CASE("the outer and the inner equator of a torus have the curvatures of its two circles") {
  const Mesh mesh = solids::torus(3, 1, 128, 64);
  const CurvatureStages s = run_stages(mesh, angle_weights());
  for (const int t : triangles_between(mesh, -0.12, 0.12)) {
    const bool is_outer = mesh.centroid(t).head<2>().norm() > 3;
    CHECK(s.curvatures[t].max == doctest::Approx(1).epsilon(0.03));
    CHECK(s.curvatures[t].min == doctest::Approx(is_outer ? 0.25 : -0.5).epsilon(0.05));
  }
}

TEST_CASE("curvatures scale with the inverse of the length") {
  const Mesh mesh = solids::capsule(1, 3, 32, 8);
  const Mesh large = solids::transformed(mesh, Affine3(Eigen::Scaling(1000.0)));
  const CurvatureStages a = run_stages(mesh);
  const CurvatureStages b = run_stages(large);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    CHECK(b.curvatures[t].max * 1000 == doctest::Approx(a.curvatures[t].max).epsilon(1e-6));
  }
}

TEST_CASE("one and four threads give the same bits") {
  const Mesh mesh = solids::transformed(solids::torus(3, 1, 64, 32), solids::oblique_transform());
  const CurvatureStages a = run_stages(mesh, {}, 1);
  const CurvatureStages b = run_stages(mesh, {}, 4);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    REQUIRE(a.curvatures[t].max == b.curvatures[t].max);
    REQUIRE(a.curvatures[t].min == b.curvatures[t].min);
  }
}

}  // namespace
}  // namespace hewn
