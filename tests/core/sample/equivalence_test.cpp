#include "core/sample/equivalence.h"

#include <doctest/doctest.h>

#include "tests/core/csg/box.h"
#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

using testing::box;

Tree single(const Literal& s) {
  Tree tree;
  tree.root = tree.add_literal(s);
  return tree;
}

Tree joined(Op op, const Literal& a, const Literal& b) {
  Tree tree;
  const int left = tree.add_literal(a);
  const int right = tree.add_literal(b);
  tree.root = tree.add_node(op, {left, right});
  return tree;
}

Equivalence compared(const Tree& a, const Tree& b, double allowed = 0) {
  EquivalenceOptions options;
  options.allowed_distance = allowed;
  const auto result = compare_trees(a, b, options, {});
  REQUIRE(result.has_value());
  return *result;
}

TEST_CASE("two ways to write a solid are the same, mostly by proof") {
  Rng rng(2);
  for (int i = 0; i < 20; ++i) {
    testing::TreeShape shape;
    shape.depth = 3;
    shape.has_complements = true;
    const Tree tree = testing::random_tree(rng, shape);
    if (!std::isfinite(tree.bounds().diagonal())) continue;
    const Equivalence e = compared(tree, flattened(tree));
    CHECK(e.is_same());
    CHECK(e.proved_share == doctest::Approx(1));
    CHECK(e.open_cells == 0);
  }
}

TEST_CASE("a contained operand can go; its surface is left to points") {
  const Literal block = box({0, 0, 0}, {4, 4, 4});
  const Equivalence e =
      compared(joined(Op::Union, block, box({1, 1, 1}, {2, 2, 4})), single(block));
  CHECK(e.is_same());
  CHECK(e.proved_share > 0.9);
  CHECK(e.open_cells > 0);
  CHECK(e.points >= EquivalenceOptions{}.points);
}

TEST_CASE("a plate of a thousandth of the diagonal is seen, and how far it reaches") {
  const Literal block = box({0, 0, 0}, {4, 4, 4});
  const Literal plate = box({1, 1, 4}, {3, 3, 4.007});
  const Equivalence e = compared(joined(Op::Union, block, plate), single(block));
  CHECK(e.different > 0);
  CHECK(e.largest_distance > 0.0005);
  CHECK(e.largest_distance < 0.008);
  REQUIRE_FALSE(e.examples.empty());
  CHECK(plate.signed_distance(e.examples[0]) < 0);
  const Equivalence tolerant = compared(joined(Op::Union, block, plate), single(block), 0.01);
  CHECK(tolerant.is_same());
  CHECK(tolerant.tolerated >= e.different);
}

TEST_CASE("solids that differ as a whole are told apart") {
  const Literal block = box({0, 0, 0}, {1, 1, 1});
  CHECK_FALSE(compared(single(block), Tree{}).is_same());
  CHECK_FALSE(compared(Tree{}, single(block)).is_same());
  CHECK(compared(Tree{}, Tree{}).is_same());
  CHECK_FALSE(compared(single(block), joined(Op::Difference, block, box({0, 0, 0}, {0.01, 1, 1})))
                  .is_same());
}

TEST_CASE("an upper bound of the distance to the surface") {
  const Tree tree = single(box({0, 0, 0}, {2, 2, 2}));
  const TreeRays rays(tree);
  TreeRayScratch scratch;
  CHECK(distance_along_rays(rays, Vec3(1, 1, 1.7), 0, scratch) == doctest::Approx(0.3));
  CHECK(distance_along_rays(rays, Vec3(1, 1, 2.5), 0, scratch) == doctest::Approx(0.5));
  CHECK(distance_along_rays(rays, Vec3(9, 5.5, 1), 0, scratch) == kInfinity);
}

}  // namespace
}  // namespace hewn
