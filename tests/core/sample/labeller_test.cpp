#include "core/sample/labeller.h"

#include <doctest/doctest.h>

#include "tests/support/part_problem.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

/// The group that is a cylinder; the test part has one.
int hole_group(const Segmentation& segmentation) {
  for (std::size_t g = 0; g < segmentation.groups.size(); ++g) {
    if (segmentation.groups[g].surface.kind == SurfaceKind::Cylinder) return static_cast<int>(g);
  }
  return -1;
}

TEST_CASE("with no partition every point is labelled by the mesh") {
  const solids::PartProblem part(solids::plate_with_hole({10, 8, 2}, 2, 24));
  const Labeller label(part.query, part.segmentation, {}, false);
  CHECK(label({4, 0, 0}) == Label::Inside);
  CHECK(label({0, 0, 0}) == Label::Outside);
  CHECK(label({40, 0, 0}) == Label::Outside);
}

TEST_CASE("a subtracted partition swaps the labels next to it and ignores the rest") {
  const solids::PartProblem part(solids::plate_with_hole({10, 8, 2}, 2, 24));
  const int hole = hole_group(part.segmentation);
  REQUIRE(hole >= 0);
  const Labeller label(part.query, part.segmentation, {hole}, true);
  CHECK(label({1.5, 0, 0}) == Label::Inside);
  CHECK(label({2.2, 0, 0}) == Label::Outside);
  CHECK(label({4.9, 0, 0}) == Label::DontCare);
  CHECK(label.owns_group(hole));
  CHECK(!label.owns_all());
}

}  // namespace
}  // namespace hewn
