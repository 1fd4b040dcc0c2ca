#include "core/synth/rebuild/feature_points.h"

#include <doctest/doctest.h>

#include "core/csg/tree_inside.h"
#include "tests/core/csg/box.h"

namespace hewn {
namespace {

using testing::box;

/// A block with a slit of 0.1 across, and on it a wall of 0.1.
Tree slit_and_wall() {
  Tree tree;
  const int block = tree.add_literal(box({0, 0, 0}, {4, 4, 1}));
  const int wall = tree.add_literal(box({1, 0, 1}, {1.1, 4, 2}));
  const int slit = tree.add_literal(box({3, -1, -1}, {3.1, 5, 3}));
  const int both = tree.add_node(Op::Union, {block, wall});
  tree.root = tree.add_node(Op::Difference, {both, slit});
  return tree;
}

TEST_CASE("points beside one in a wall or a slit lie near its middle") {
  const Tree tree = slit_and_wall();
  const TreeRays rays(tree);
  const TreeInside inside(tree);
  for (const bool is_wall : {true, false}) {
    CAPTURE(is_wall);
    const double middle = is_wall ? 1.05 : 3.05;
    const Vec3 p(middle + 0.03, 2, is_wall ? 1.5 : 0.5);
    Rng rng(5);
    const auto points = points_beside(rays, p, 40, 5, rng);
    CHECK(points.size() >= 10);
    std::size_t in_feature = 0;
    for (const Vec3& q : points) {
      CHECK(inside.contains(q) == is_wall);
      if (std::abs(q.x() - middle) < 0.005) ++in_feature;
    }
    CHECK(2 * in_feature > points.size());
  }
}

TEST_CASE("far outside there is no feature") {
  const Tree tree = slit_and_wall();
  const TreeRays rays(tree);
  Rng rng(5);
  CHECK(points_beside(rays, {20, 20, 20}, 10, 5, rng).empty());
}

}  // namespace
}  // namespace hewn
