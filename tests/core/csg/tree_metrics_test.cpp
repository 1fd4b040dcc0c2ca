#include <doctest/doctest.h>

#include "random_tree.h"

namespace hewn {
namespace {

Literal cube(double x) {
  Literal s;
  s.origin = Vec3(x, 0, 0);
  s.size = Vec3::Ones();
  return s;
}

std::vector<Vec3> row_of_points() {
  std::vector<Vec3> points;
  for (int i = 0; i < 100; ++i) points.emplace_back(0.05 + 0.1 * i, 0.5, 0.5);
  return points;
}

TEST_CASE("size counts literals and binary operations, and complements as nodes") {
  Tree tree;
  const int a = tree.add_literal(cube(0));
  const int b = tree.add_literal(cube(1));
  const int c = tree.add_literal(cube(2));
  tree.root = tree.add_node(Op::Union, {a, b, c});
  CHECK(literal_count(tree) == 3);
  CHECK(tree_size(tree) == 5);
  tree.root = tree.add_node(Op::Complement, {tree.root});
  CHECK(tree_size(tree) == 6);
  tree.root = tree.add_node(Op::Union, {tree.root});
  CHECK(tree_size(tree) == 6);
  tree.add_literal(cube(9));
  CHECK(literal_count(tree) == 3);
}

TEST_CASE("proximity is one when all operands overlap and less when they do not") {
  Tree tree;
  const int a = tree.add_literal(cube(0));
  const int b = tree.add_literal(cube(0.5));
  const int c = tree.add_literal(cube(5));
  tree.root = tree.add_node(Op::Union, {a, b});
  CHECK(proximity(tree, row_of_points()) == doctest::Approx(1));
  tree.root = tree.add_node(Op::Union, {a, c});
  CHECK(proximity(tree, row_of_points()) == doctest::Approx(2.0 / 3));
  tree.root = tree.add_node(Op::Union, {a, b, c});
  CHECK(proximity(tree, row_of_points()) == doctest::Approx(4.0 / 5));
}

TEST_CASE("proximity follows the left fold, not the literals") {
  Tree tree;
  const int a = tree.add_literal(cube(0));
  const int b = tree.add_literal(cube(0));
  const int c = tree.add_literal(cube(0));
  // After a - b nothing is left that c could overlap.
  tree.root = tree.add_node(Op::Difference, {a, b, c});
  CHECK(proximity(tree, row_of_points()) == doctest::Approx(4.0 / 5));
}

TEST_CASE("complements of separate solids overlap everywhere else") {
  Tree tree;
  const int a = tree.add_node(Op::Complement, {tree.add_literal(cube(0))});
  const int b = tree.add_node(Op::Complement, {tree.add_literal(cube(5))});
  tree.root = tree.add_node(Op::Intersection, {a, b});
  CHECK(proximity(tree, row_of_points()) == doctest::Approx(1));
  // A single point inside both cubes' complements' outside: no bit beyond the last point counts.
  CHECK(proximity(tree, {Vec3(0.5, 0.5, 0.5)}) == doctest::Approx(4.0 / 5));
}

TEST_CASE("proximity lies between the share of literals and one") {
  Rng rng(31);
  for (int i = 0; i < 100; ++i) {
    const Tree tree = testing::random_tree(rng, {.has_complements = true});
    std::vector<Vec3> points;
    for (int k = 0; k < 77; ++k) points.push_back(testing::random_point(rng, 2));
    const double p = proximity(tree, points);
    CHECK(p <= 1);
    CHECK(p >= static_cast<double>(literal_count(tree)) / tree_size(tree) - 1e-12);
  }
}

}  // namespace
}  // namespace hewn
