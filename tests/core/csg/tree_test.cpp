#include "core/csg/tree.h"

#include <doctest/doctest.h>

#include "random_tree.h"

namespace hewn {
namespace {

Literal ball(double x, double radius) {
  Literal s;
  s.kind = SolidKind::Sphere;
  s.origin = Vec3(x, 0, 0);
  s.radius = radius;
  return s;
}

TEST_CASE("the empty tree holds no point") {
  const Tree tree;
  CHECK_FALSE(tree.contains(Vec3::Zero()));
  CHECK(tree.bounds().is_empty());
  CHECK(tree_size(tree) == 0);
  CHECK(literal_count(tree) == 0);
}

TEST_CASE("a difference of three is a left fold") {
  Tree tree;
  const int a = tree.add_literal(ball(0, 3));
  const int b = tree.add_literal(ball(3, 1));
  const int c = tree.add_literal(ball(-3, 1));
  tree.root = tree.add_node(Op::Difference, {a, b, c});
  CHECK(tree.contains(Vec3::Zero()));
  CHECK_FALSE(tree.contains({2.5, 0, 0}));
  CHECK_FALSE(tree.contains({-2.5, 0, 0}));
  CHECK(tree.signed_distance({2.5, 0, 0}) == doctest::Approx(0.5));
}

TEST_CASE("a grafted tree keeps its solid and leaves the host's alone") {
  Tree host;
  host.root = host.add_literal(ball(0, 1));
  Tree guest;
  const int a = guest.add_literal(ball(5, 2));
  const int b = guest.add_literal(ball(5, 1));
  guest.root = guest.add_node(Op::Difference, {a, b});
  const int root = host.graft(guest);
  CHECK(host.contains(Vec3::Zero()));
  CHECK_FALSE(host.contains({6.5, 0, 0}));
  host.root = host.add_node(Op::Union, {host.root, root});
  CHECK(host.contains({6.5, 0, 0}));
  CHECK_FALSE(host.contains({5, 0, 0}));
  CHECK(host.graft(Tree{}) == -1);
}

TEST_CASE("a tree grafted onto itself is doubled") {
  Tree tree;
  tree.root = tree.add_literal(ball(0, 1));
  const int copy = tree.graft(tree);
  tree.root = tree.add_node(Op::Union, {tree.root, copy});
  CHECK(literal_count(tree) == 2);
}

TEST_CASE("the bounds of random trees hold their solids") {
  Rng rng(21);
  for (int i = 0; i < 200; ++i) {
    const Tree tree = testing::random_tree(rng, {});
    const Box3 box = tree.bounds();
    for (int k = 0; k < 100; ++k) {
      const Vec3 x = testing::random_point(rng, 3);
      if (tree.contains(x)) CHECK(box.contains(x, 1e-12));
    }
  }
}

TEST_CASE("no boundary lies closer to a point than the tree's distance") {
  Rng rng(22);
  for (int i = 0; i < 200; ++i) {
    const Tree tree = testing::random_tree(rng, {.has_complements = true});
    for (int k = 0; k < 20; ++k) {
      const Vec3 x = testing::random_point(rng, 2);
      const double d = tree.signed_distance(x);
      const double reach = std::min(std::abs(d), 10.0) * 0.999;
      const Vec3 y = x + testing::random_point(rng, 1).normalized() * reach;
      CHECK(tree.contains(y) == (d < 0));
    }
  }
}

}  // namespace
}  // namespace hewn
