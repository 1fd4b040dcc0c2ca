#include "core/sample/point_sets.h"

#include <doctest/doctest.h>

#include "tests/core/csg/box.h"

namespace hewn {
namespace {

using testing::box;

/// A block and a plate of a thousandth of its size in the middle of it.
Arrangement block_and_plate() {
  return ArrangementSampler({box({0, 0, 0}, {8, 8, 8}), box({2, 2, 3.9}, {6, 6, 3.908})}, 14)
      .arrangement();
}

std::size_t cells_of(const Arrangement& arrangement, const std::vector<Vec3>& points) {
  ArrangementSampler sampler(arrangement.literals, arrangement.scale);
  return sampler.add(points, {});
}

TEST_CASE("an octree divides only cells that a surface may pass through") {
  const Arrangement one = ArrangementSampler({box({0, 0, 0}, {8, 8, 8})}, 14).arrangement();
  // Twice, for the box of all and the box of the one. The surface may pass through every octant of
  // the root, but not through every cell of theirs.
  const auto points = octree_points(one, 2, {});
  CHECK(points.size() == 2 * (1 + 8 + 64));
  const auto finer = octree_points(one, 1, {});
  CHECK(finer.size() < 2 * (1 + 8 + 64 + 512));
  CHECK(finer.size() > points.size());
}

TEST_CASE("a plate thinner than every step is found") {
  const Arrangement a = block_and_plate();
  CHECK(cells_of(a, octree_points(a, 1, {})) >= 2);
  CHECK(cells_of(a, grid_points(a, 1)) == 3);
  // The grid alone would pass it by.
  std::vector<Vec3> points = grid_points(a, 1);
  points.erase(points.begin(), points.begin() + 2);
  CHECK(cells_of(a, points) == 2);
}

TEST_CASE("neither takes more than its share of points") {
  const Arrangement a = block_and_plate();
  CHECK(octree_points(a, 1e-9, {}).size() <= 400'000);
  CHECK(grid_points(a, 1e-9).size() <= 500'000);
}

TEST_CASE("the octree is the same for any number of threads") {
  const Arrangement a = block_and_plate();
  RunContext many;
  many.threads = 3;
  RunContext one;
  one.threads = 1;
  CHECK(octree_points(a, 0.5, many) == octree_points(a, 0.5, one));
}

}  // namespace
}  // namespace hewn
