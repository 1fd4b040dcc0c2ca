#include "core/csg/protrude.h"

#include <doctest/doctest.h>

#include "random_tree.h"
#include "tests/core/csg/box.h"

namespace hewn {
namespace {

using testing::box;

Literal hole(double from, double to, double bottom, double top) {
  Literal s;
  s.kind = SolidKind::Cylinder;
  s.origin = Vec3(5, 5, from);
  s.height = to - from;
  s.radius = bottom;
  s.top_radius = top;
  return s;
}

/// The tool after the pass, cut from a plate of 10 x 10 x 2 (and what `add` unites with it).
Literal cut(const Literal& tool, const std::vector<Literal>& add = {}) {
  Tree tree;
  std::vector<int> parts = {tree.add_literal(box({0, 0, 0}, {10, 10, 2}))};
  for (const Literal& s : add) parts.push_back(tree.add_literal(s));
  const int base = tree.add_node(Op::Union, parts);
  const int leaf = tree.add_literal(tool);
  tree.root = tree.add_node(Op::Difference, {base, leaf});
  const Tree result = with_protruding_tools(tree);
  return result.literals[result.nodes[leaf].literal];
}

TEST_CASE("a flush hole is lengthened on both ends by a round amount") {
  const Literal longer = cut(hole(0, 2, 1, 1));
  CHECK(longer.origin.z() == -1);
  CHECK(longer.height == 4);
}

TEST_CASE("a blind hole keeps its bottom") {
  const Literal longer = cut(hole(1, 2, 1, 1));
  CHECK(longer.origin.z() == 1);
  CHECK(longer.height == 2);
}

TEST_CASE("a tool that sticks out already stays as it is") {
  const Literal same = cut(hole(-3, 7, 1, 1));
  CHECK(same.origin.z() == -3);
  CHECK(same.height == 10);
}

TEST_CASE("a notch grows only out of the plate's sides") {
  const Literal longer = cut(box({0, 4, 1}, {2, 6, 2}));
  CHECK(longer.origin == Vec3(-1, 4, 1));
  CHECK(longer.size == Vec3(3, 2, 2));
}

TEST_CASE("an end stops short of what lies behind it") {
  const Literal lid = box({0, 0, 2.3}, {10, 10, 4});
  const Literal longer = cut(hole(0, 2, 1, 1), {lid});
  CHECK(longer.origin.z() == -1);
  CHECK(longer.height == doctest::Approx(3.2));
}

TEST_CASE("a countersink keeps its slope") {
  const Literal longer = cut(hole(1, 2, 1, 2));
  CHECK(longer.origin.z() == 1);
  CHECK(longer.height == 2);
  CHECK(longer.top_radius == 3);
}

TEST_CASE("the pass keeps the solid of random trees with flush tools") {
  Rng rng(51);
  int moved = 0;
  for (int i = 0; i < 60; ++i) {
    Tree tree;
    std::vector<int> base;
    for (int k = 0; k < 3; ++k) {
      const Vec3 lo(static_cast<double>(rng.below(6)), 0, static_cast<double>(rng.below(3)));
      const Vec3 size(static_cast<double>(1 + rng.below(4)), 4,
                      static_cast<double>(1 + rng.below(4)));
      base.push_back(tree.add_literal(box(lo, lo + size)));
    }
    const Vec3 lo(static_cast<double>(rng.below(6)), static_cast<double>(rng.below(3)), 1);
    const int tool = tree.add_literal(box(lo, lo + Vec3(2, 2, 2)));
    const int solid = tree.add_node(Op::Union, base);
    tree.root = tree.add_node(Op::Difference, {solid, tool});
    const Tree longer = with_protruding_tools(tree);
    if (longer.literals[tree.nodes[tool].literal].size !=
        tree.literals[tree.nodes[tool].literal].size) {
      ++moved;
    }
    for (int k = 0; k < 300; ++k) {
      Vec3 x = testing::random_point(rng, 5) + Vec3(5, 2, 3);
      CHECK(longer.contains(x) == tree.contains(x));
    }
  }
  CHECK(moved > 30);
}

}  // namespace
}  // namespace hewn
