#include "core/synth/decompose/shorten.h"

#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "tests/core/csg/box.h"
#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

using testing::box;

/// A wall, a slot through it that goes on behind it, and a rib behind the wall at `rib`.
Tree slotted_wall(double rib) {
  Tree tree;
  const int wall = tree.add_literal(box({0, 0, 0}, {10, 1, 5}));
  const int behind = tree.add_literal(box({4, rib, 0}, {6, rib + 1, 5}));
  const int slot = tree.add_literal(box({4.5, -1, 2}, {5.5, 20, 3}));
  const int both = tree.add_node(Op::Union, {wall, behind});
  tree.root = tree.add_node(Op::Difference, {both, slot});
  return tree;
}

TEST_CASE("a tool ends behind the last thing that it cuts") {
  const Shortening short_slot{2, box({4.5, -1, 2}, {5.5, 2, 3})};
  Tree tree = slotted_wall(30);  // out of the tool's reach
  shorten_tools(tree, {short_slot});
  CHECK(tree.literals[2].size.y() == doctest::Approx(3));
  CHECK(tree.literals[2].origin.y() == -1);
  Tree with_rib = slotted_wall(8);
  shorten_tools(with_rib, {short_slot});
  CHECK(with_rib.literals[2].size.y() == 21);
}

TEST_CASE("a sheet that is left of a block keeps its hole") {
  Tree tree;
  const int wall = tree.add_literal(box({0, 0, 0}, {10, 1, 5}));
  const int block = tree.add_literal(box({0, 10, 0}, {10, 20, 5}));
  const int most_of_it = tree.add_literal(box({-1, 10.002, -1}, {11, 21, 6}));
  const int slot = tree.add_literal(box({4.5, -1, 2}, {5.5, 25, 3}));
  const int sheet = tree.add_node(Op::Difference, {block, most_of_it});
  tree.root = tree.add_node(Op::Difference, {tree.add_node(Op::Union, {wall, sheet}), slot});
  shorten_tools(tree, {{slot, box({4.5, -1, 2}, {5.5, 2, 3})}});
  CHECK(tree.literals[static_cast<std::size_t>(slot)].size.y() == 26);
}

TEST_CASE("ends move one by one, and what is united again afterwards does not count") {
  Tree tree = slotted_wall(8);
  const int again = tree.add_literal(box({4, 8, 0}, {6, 9, 5}));
  tree.root = tree.add_node(Op::Union, {tree.root, again});
  // The slot may end behind the wall, but it must not begin within it.
  shorten_tools(tree, {{2, box({4.5, 0.5, 2}, {5.5, 2, 3})}});
  CHECK(tree.literals[2].origin.y() == -1);
  CHECK(tree.literals[2].size.y() == doctest::Approx(3));
}

TEST_CASE("shortened trees are the same solids") {
  Rng rng(3);
  for (int i = 0; i < 20; ++i) {
    const Tree before = slotted_wall(rng.uniform(-3, 12));
    Tree after = before;
    const Vec3 hi(rng.uniform(4.6, 5.5), rng.uniform(-0.9, 19), rng.uniform(2.1, 3));
    shorten_tools(after, {{2, box({4.5, -1, 2}, hi)}});
    for (int k = 0; k < 2000; ++k) {
      const Vec3 p(rng.uniform(3, 7), rng.uniform(-4, 14), rng.uniform(0, 5));
      REQUIRE(before.contains(p) == after.contains(p));
    }
  }
}

}  // namespace
}  // namespace hewn
