#include "core/synth/rebuild/rebuild.h"

#include <doctest/doctest.h>

#include "core/csg/tree_inside.h"
#include "core/synth/optimise.h"
#include "core/synth/rebuild/tree_surfaces.h"
#include "tests/core/csg/box.h"
#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

using testing::random_point;

using testing::box;

Literal tube(double x, double y, double radius, double from, double to) {
  Literal s;
  s.kind = SolidKind::Cylinder;
  s.origin = {x, y, from};
  s.radius = s.top_radius = radius;
  s.height = to - from;
  return s;
}

/// A plate of eight small boxes and a hole drilled in two steps: two primitives would do.
Tree cut_up_plate() {
  Tree tree;
  std::vector<int> boxes;
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 2; ++y) {
      boxes.push_back(tree.add_literal(box({1.0 * x, 1.0 * y, 0}, {x + 1.0, y + 1.0, 1})));
    }
  }
  const int plate = tree.add_node(Op::Union, boxes);
  const int lower = tree.add_literal(tube(2, 1, 0.4, -1, 0.5));
  const int upper = tree.add_literal(tube(2, 1, 0.4, 0.5, 2));
  tree.root = tree.add_node(Op::Difference, {plate, lower, upper});
  return tree;
}

TEST_CASE("membership without distances equals membership by distance") {
  Rng rng(5);
  testing::TreeShape shape;
  shape.has_complements = true;
  for (int i = 0; i < 60; ++i) {
    const Tree tree = testing::random_tree(rng, shape);
    const TreeInside inside(tree);
    for (int k = 0; k < 300; ++k) {
      const Vec3 x = random_point(rng, 3);
      if (std::abs(tree.signed_distance(x)) < 1e-9) continue;
      REQUIRE(inside.contains(x) == tree.contains(x));
    }
  }
}

TEST_CASE("literals that share faces share halfspaces") {
  const auto two = surfaces_of({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 3})}, 1);
  REQUIRE(two.has_value());
  // Of twelve faces the common one and those in the planes y = 0, y = 1, z = 0 coincide.
  CHECK(two->all.halfspaces.size() == 8);
  CHECK(two->all.directions.size() == 3);
  const auto round = surfaces_of({tube(0, 0, 1, 0, 1), tube(0, 0, 1, 1, 2)}, 1);
  REQUIRE(round.has_value());
  CHECK(round->all.halfspaces.size() == 4);
  CHECK(round->nearest(0, Vec3(0, 0, 0.999)) == round->nearest(1, Vec3(0, 0, 1.001)));
  Rng rng(3);
  Literal cone = tube(0, 0, 1, 0, 1);
  cone.top_radius = 0.5;
  const auto flank = surfaces_of({cone}, 1);
  REQUIRE(flank.has_value());
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = random_point(rng, 1.2);
    bool inside = true;
    for (const Halfspace& h : flank->all.halfspaces) {
      const bool is_base = h.surface.kind == SurfaceKind::Plane && h.surface.offset == 0;
      inside = inside && (h.surface.signed_distance(p) < 0) != is_base;
    }
    CHECK(inside == (cone.signed_distance(p) < 0));
  }
  Literal oval = tube(0, 0, 1, 0, 1);
  oval.stretch = Stretch::of(Vec3(2, 1, 1).asDiagonal());
  CHECK_FALSE(surfaces_of({oval}, 1).has_value());
}

TEST_CASE("the surfaces of a solid tell how many primitives it needs at least") {
  const RunContext run;
  const auto least = [&](const Tree& tree) {
    const RebuildOptions options;
    const std::vector<Vec3> points = {{1, 1, 0.5}};
    return TreeRebuilder(tree, points, tree.bounds().diagonal(), options, run).least_literals();
  };
  // One flank, and four sides in pairs that one box has.
  CHECK(least(cut_up_plate()) == 2);
  // Six planes across z: three boxes; the cylinder's own ends are two of them.
  Tree stairs;
  std::vector<int> steps;
  for (int i = 0; i < 3; ++i) {
    steps.push_back(stairs.add_literal(box({1.0 * i, 0, 0.1 * i}, {i + 1.5, 1, i + 1.0})));
  }
  stairs.root = stairs.add_node(Op::Union, steps);
  CHECK(least(stairs) == 3);
  const int peg = stairs.add_literal(tube(0.5, 0.5, 0.2, 0.5, 5));
  stairs.root = stairs.add_node(Op::Union, {stairs.root, peg});
  CHECK(least(stairs) == 4);
  RebuildOptions tolerant;
  tolerant.depth = 0.1;
  const std::vector<Vec3> points = {{1, 1, 0.5}};
  CHECK(TreeRebuilder(stairs, points, 5, tolerant, run).least_literals() == 0);
}

TEST_CASE("a tree as small as its surfaces allow is not searched any longer") {
  Tree tree;
  const int plate = tree.add_literal(box({0, 0, 0}, {4, 2, 1}));
  const int hole = tree.add_literal(tube(1, 1, 0.4, -1, 2));
  tree.root = tree.add_node(Op::Difference, {plate, hole});
  const auto result = optimise(tree, {}, {});
  REQUIRE(result.has_value());
  CHECK(result->after.literals == 2);
  CHECK(result->rounds == 1);
  CHECK(result->equivalence.is_same());
}

TEST_CASE("a cut-up solid is built anew from its few surfaces") {
  const Tree tree = cut_up_plate();
  const std::vector<Vec3> points = {{0.5, 0.5, 0.5}, {2, 1, 0.25}, {2, 1, 0.75}, {3.5, 1.5, 0.5}};
  const RebuildOptions options;
  const RunContext run;
  TreeRebuilder rebuilder(tree, points, tree.bounds().diagonal(), options, run);
  const auto found = rebuilder.next(0);
  REQUIRE(found.has_value());
  REQUIRE(found->has_value());
  CHECK(literal_count(**found) == 2);
  Rng rng(9);
  std::vector<Vec3> fresh;
  for (int i = 0; i < 5000; ++i) fresh.push_back(Vec3(2, 1, 0.5) + random_point(rng, 2.5));
  const std::vector<LabelledPoint> labelled = rebuilder.labelled(fresh);
  CHECK(rebuilder.refute(**found, labelled, TreeRebuilder::Take::WrongAndNew) == 0);
  // No tree is that small.
  TreeRebuilder bounded(tree, points, tree.bounds().diagonal(), options, run);
  const auto none = bounded.next(1);
  REQUIRE(none.has_value());
  CHECK_FALSE(none->has_value());
  // Another solid is refuted.
  Tree other;
  other.root = other.add_literal(box({0, 0, 0}, {4, 2, 1}));
  CHECK(rebuilder.refute(other, labelled, TreeRebuilder::Take::Wrong) > 0);
}

TEST_CASE("the optimiser merges boxes that no single primitive of the tree covers") {
  const Tree tree = cut_up_plate();
  const auto result = optimise(tree, {}, {});
  REQUIRE(result.has_value());
  CHECK(result->after.literals == 2);
  CHECK(result->after.proximity == doctest::Approx(1));
  CHECK(result->equivalence.is_same());
  OptimiseOptions keep;
  keep.rebuilds = false;
  keep.derives_primitives = false;
  const auto kept = optimise(tree, keep, {});
  REQUIRE(kept.has_value());
  CHECK(kept->after.literals == 10);
}

TEST_CASE("operands that only touch come to overlap, and proximity never falls") {
  // A block with a peg on it and a slot beside: the peg reaches down into the block.
  Tree tree;
  const int block = tree.add_literal(box({0, 0, 0}, {4, 4, 1}));
  const int peg = tree.add_literal(tube(1, 1, 0.5, 1, 2));
  tree.root = tree.add_node(Op::Union, {block, peg});
  const auto result = optimise(tree, {}, {});
  REQUIRE(result.has_value());
  CHECK(result->before.proximity < 1);
  CHECK(result->after.proximity == doctest::Approx(1));
  CHECK(result->after.literals == 2);
  const TreeInside before(tree);
  const TreeInside after(result->tree);
  Rng rng(1);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 x = Vec3(2, 2, 1) + random_point(rng, 2.5);
    if (std::abs(tree.signed_distance(x)) < 1e-6) continue;
    REQUIRE(before.contains(x) == after.contains(x));
  }
}

}  // namespace
}  // namespace hewn
