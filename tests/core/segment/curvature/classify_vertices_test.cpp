#include <doctest/doctest.h>

#include "tests/core/segment/curvature/stages.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

int extremes(const Vec3& p, const Box3& box) {
  int count = 0;
  for (int k = 0; k < 3; ++k) count += (p[k] == box.lo[k] || p[k] == box.hi[k]) ? 1 : 0;
  return count;
}

TEST_CASE("a box has faces on its sides, ridges on its edges and corners at its corners") {
  const Mesh mesh = solids::box({0, 0, 0}, {1, 2, 3}, 4);
  const CurvatureStages s = run_stages(mesh);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const VertexClass expected[] = {VertexClass::Face, VertexClass::Face, VertexClass::Ridge,
                                    VertexClass::Corner};
    CHECK(s.vertices[v] == expected[extremes(mesh.vertices[v], mesh.bounds)]);
  }
}

TEST_CASE("the classes do not depend on position, rotation and size") {
  const Mesh mesh = solids::plate_with_hole({4, 3, 1}, 0.7, 32, 2);
  Affine3 transform = solids::oblique_transform();
  transform.prescale(1000.0);
  const Mesh moved = solids::transformed(mesh, transform);
  CHECK(run_stages(mesh).vertices == run_stages(moved).vertices);
}

TEST_CASE("the rim of a cylinder is a ridge, its flank is a face") {
  const Mesh mesh = solids::cylinder(1, 2, 48, 4);
  const CurvatureStages s = run_stages(mesh);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3& p = mesh.vertices[v];
    const bool is_rim = p.head<2>().norm() > 0.5 && (p.z() == 0 || p.z() == 2);
    CHECK(s.vertices[v] == (is_rim ? VertexClass::Ridge : VertexClass::Face));
  }
}

TEST_CASE("the apex of a sharp cone is a corner") {
  const Mesh mesh = solids::cone(1, 0, 3, 48, 4);
  const CurvatureStages s = run_stages(mesh);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (mesh.vertices[v].z() == 3) CHECK(s.vertices[v] == VertexClass::Corner);
  }
}

TEST_CASE("two planes meet in a ridge only above the ridge angle") {
  // A roof of two squares over the unit edge, and nothing else.
  const auto roof_class = [](double fold_deg) {
    const double a = fold_deg * kPi / 180;
    const Mesh mesh =
        make_mesh({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {-1, 1, 0}, {std::cos(a), 1, -std::sin(a)}},
                  {{0, 1, 3}, {1, 2, 3}, {1, 0, 4}, {2, 1, 4}});
    CurvatureOptions options;
    options.ridge_angle_deg = 30;
    return run_stages(mesh, options).vertices[1];
  };
  CHECK(roof_class(29) == VertexClass::Face);
  CHECK(roof_class(31) == VertexClass::Ridge);
}

TEST_CASE("a cancelled run reports so") {
  RunContext run;
  run.cancel->cancel();
  const Mesh mesh = solids::box({0, 0, 0}, {1, 1, 1});
  const auto result = compute_stages(mesh, {}, run);
  REQUIRE_FALSE(result.has_value());
  CHECK(result.error().code == ErrorCode::Cancelled);
}

}  // namespace
}  // namespace hewn
