#include <doctest/doctest.h>

#include "tests/core/segment/curvature/stages.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

int marked_sides(const Boundaries& boundaries) {
  int count = 0;
  for (const auto& sides : boundaries.is_marked) {
    for (const bool is_marked : sides) count += is_marked ? 1 : 0;
  }
  return count;
}

TEST_CASE("exactly the edges of a box are marked, from both sides") {
  const CurvatureStages s = run_stages(solids::box({0, 0, 0}, {1, 2, 3}, 4));
  CHECK(marked_sides(s.boundaries) == 2 * 12 * 4);
}

TEST_CASE("three groups meet at a box's corner, two at its edges, one on its sides") {
  const Mesh mesh = solids::box({0, 0, 0}, {1, 1, 1}, 2);
  const CurvatureStages s = run_stages(mesh);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 off_centre = (mesh.vertices[v] - Vec3::Constant(0.5)).cwiseAbs();
    const int on_sides = static_cast<int>((off_centre.array() == 0.5).count());
    CHECK(s.boundaries.group_count[v] == on_sides);
  }
}

TEST_CASE("the facets of a cylinder's flank are not separated") {
  const CurvatureStages s = run_stages(solids::cylinder(1, 2, 36, 1));
  CHECK(marked_sides(s.boundaries) == 2 * 2 * 36);
}

TEST_CASE("the rim of a hole in the mesh is a boundary") {
  const Mesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  CHECK(marked_sides(run_stages(mesh).boundaries) == 3);
}

}  // namespace
}  // namespace hewn
