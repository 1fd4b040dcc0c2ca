#include <doctest/doctest.h>

#include "tests/core/segment/curvature/stages.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

CurvatureClass classify(double max, double min) {
  return class_of(max, min, curvature_limits(10, {}));
}

TEST_CASE("principal curvatures decide the class and its inversion") {
  CHECK(classify(0.001, 0) == CurvatureClass::Planar);
  CHECK(classify(1, 0.9) == CurvatureClass::Spherical);
  CHECK(classify(-1, -0.9) == CurvatureClass::SphericalInverted);
  CHECK(classify(1, 0.01) == CurvatureClass::Conic);
  CHECK(classify(-1, 0.01) == CurvatureClass::ConicInverted);
  CHECK(classify(1, 0.5) == CurvatureClass::Other);
  CHECK(classify(1, -0.5) == CurvatureClass::Other);
}

TEST_CASE("a capsule is spherical, conic and spherical") {
  const Mesh mesh = solids::capsule(1, 4, 64, 16);
  const CurvatureStages s = run_stages(mesh);
  const auto middle = triangles_between(mesh, -1e-9, 4 + 1e-9);
  for (const int t : middle) CHECK(s.classes[t] == CurvatureClass::Conic);
  // Away from the seam and from the pole.
  const auto cap = triangles_between(mesh, -0.9, -0.2);
  REQUIRE(cap.size() > 500);
  for (const int t : cap) CHECK(s.classes[t] == CurvatureClass::Spherical);
}

TEST_CASE("a plate is planar and its hole an inverted cone") {
  const Mesh mesh = solids::plate_with_hole({8, 8, 2}, 2, 32, 2);
  const CurvatureStages s = run_stages(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 c = mesh.centroid(static_cast<int>(t));
    const bool is_wall = c.head<2>().norm() < 2.01 && std::abs(mesh.normals[t].z()) < 0.5;
    CHECK(s.classes[t] == (is_wall ? CurvatureClass::ConicInverted : CurvatureClass::Planar));
  }
}

TEST_CASE("a triangle without area has no class") {
  const Mesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}});
  CHECK(run_stages(mesh).classes[0] == CurvatureClass::None);
}

}  // namespace
}  // namespace hewn
