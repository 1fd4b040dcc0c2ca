#include "core/csg/tree_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include "core/csg/tree_inside.h"
#include "tests/core/csg/box.h"
#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

using testing::box;

TreeBoundary boundary_of(const Tree& tree, double diagonal, int threads = 1) {
  RunContext run;
  run.threads = threads;
  const auto boundary = tree_boundary(tree, diagonal, run);
  REQUIRE(boundary);
  return *boundary;
}

struct Measures {
  double area = 0, volume = 0;
};

Measures measure(const TreeBoundary& boundary) {
  Measures out;
  for (std::size_t i = 0; i + 2 < boundary.corners.size(); i += 3) {
    const Vec3& a = boundary.corners[i].position;
    const Vec3& b = boundary.corners[i + 1].position;
    const Vec3& c = boundary.corners[i + 2].position;
    const Vec3 across = (b - a).cross(c - a);
    out.area += across.norm() / 2;
    out.volume += across.dot(a) / 6;
    CHECK(across.dot(boundary.corners[i].normal) > 0);
  }
  return out;
}

Tree of_one(Literal literal) {
  Tree tree;
  tree.root = tree.add_literal(std::move(literal));
  return tree;
}

TEST_CASE("the boundary of one literal has its area and volume") {
  Literal s;
  Rng rng(1, 2);
  s.rotation = testing::random_rotation(rng);
  s.origin = {1, 2, 3};
  s.size = {1, 2, 3};
  Measures m = measure(boundary_of(of_one(s), 4));
  CHECK(m.area == doctest::Approx(22));
  CHECK(m.volume == doctest::Approx(6));

  s.kind = SolidKind::Cylinder;
  s.radius = s.top_radius = 2;
  s.height = 3;
  m = measure(boundary_of(of_one(s), 5));
  CHECK(m.area == doctest::Approx(2 * kPi * 2 * (2 + 3)).epsilon(2e-3));
  CHECK(m.volume == doctest::Approx(kPi * 4 * 3).epsilon(4e-3));

  s.kind = SolidKind::Sphere;
  m = measure(boundary_of(of_one(s), 4));
  CHECK(m.area == doctest::Approx(4 * kPi * 4).epsilon(4e-3));
  CHECK(m.volume == doctest::Approx(4.0 / 3 * kPi * 8).epsilon(6e-3));

  s.kind = SolidKind::Torus;
  s.major_radius = 5;
  m = measure(boundary_of(of_one(s), 14));
  CHECK(m.volume == doctest::Approx(2 * kPi * kPi * 5 * 4).epsilon(8e-3));

  s.kind = SolidKind::Prism;
  s.sides = 6;
  s.radius = 1;
  m = measure(boundary_of(of_one(s), 4));
  CHECK(m.volume == doctest::Approx(2 * std::sqrt(3.0) * 3));

  s.kind = SolidKind::Cylinder;
  s.stretch = Stretch::of(Vec3(2, 1, 1).asDiagonal());
  s.top_radius = 1;
  m = measure(boundary_of(of_one(s), 6));
  CHECK(m.volume == doctest::Approx(2 * kPi * 3).epsilon(4e-3));

  CHECK(measure(boundary_of(of_one(polyhedron_literal(
                                std::make_shared<const Mesh>(testing::tetrahedron(3)))),
                            4))
            .volume == doctest::Approx(27.0 / 6));
}

TEST_CASE("the boundary of random trees encloses what they hold") {
  constexpr int kTrees = 12;
  constexpr int kPoints = 20000;
  for (int k = 0; k < kTrees; ++k) {
    CAPTURE(k);
    Rng rng(7, static_cast<std::uint64_t>(k));
    Tree tree = testing::random_tree(rng, {.depth = 3});
    const Box3 bounds = tree.bounds();
    if (bounds.is_empty()) continue;
    // Complements may reach beyond.
    const int frame = tree.add_literal(box(bounds.lo, bounds.hi));
    tree.root = tree.add_node(Op::Intersection, {tree.root, frame});
    const TreeInside solid(tree);
    int inside = 0;
    for (int i = 0; i < kPoints; ++i) {
      Vec3 p;
      for (int c = 0; c < 3; ++c) p[c] = rng.uniform(bounds.lo[c], bounds.hi[c]);
      inside += solid.contains(p) ? 1 : 0;
    }
    const double whole = (bounds.hi - bounds.lo).prod();
    const double share = static_cast<double>(inside) / kPoints;
    const TreeBoundary boundary = boundary_of(tree, bounds.diagonal());
    CHECK(std::abs(measure(boundary).volume / whole - share) < 0.02);
    for (const BoundaryCorner& c : boundary.corners) {
      CHECK(std::abs(tree.signed_distance(c.position)) < 2e-3 * bounds.diagonal());
    }
  }
}

Literal cylinder(double radius, double height) {
  Literal s;
  s.kind = SolidKind::Cylinder;
  s.radius = s.top_radius = radius;
  s.height = height;
  return s;
}

TEST_CASE("a bar with a round end: planes through the round end's axis, and planes that touch it") {
  for (int k = 0; k < 10; ++k) {
    CAPTURE(k);
    const bool is_bar_first = k % 2 == 0;
    Literal bar = box({-1, 0, 0}, {1, 4, 1});  // the seam of the end lies in its side
    Literal end = cylinder(1, 1);
    Rng rng(5, static_cast<std::uint64_t>(k / 2));
    bar.rotation = end.rotation = testing::random_rotation(rng);  // so that zeros have two signs
    Tree tree;
    const int first = tree.add_literal(is_bar_first ? bar : end);
    const int second = tree.add_literal(is_bar_first ? end : bar);
    tree.root = tree.add_node(Op::Union, {first, second});
    const Measures found = measure(boundary_of(tree, 5.5));
    const double ends = 2 * (8 + kPi / 2);
    CHECK(found.area == doctest::Approx(ends + 2 * 4 + 2 + kPi).epsilon(2e-3));
    CHECK(found.volume == doctest::Approx(8 + kPi / 2).epsilon(2e-3));
  }
}

TEST_CASE("a face that several literals have is drawn once, also where only a part is common") {
  // All in any order: a low block, a high one that holds it, and the one that cuts both down.
  const Literal literals[] = {box({0, 0, 0}, {1, 4, 1}), box({0, 0, 0}, {4, 4, 2}),
                              box({0, 0, 0}, {4, 4, 1})};
  std::array<int, 3> order = {0, 1, 2};
  do {
    CAPTURE(order[0]);
    CAPTURE(order[1]);
    Tree tree;
    std::array<int, 3> leaf{};
    for (const int l : order) leaf[l] = tree.add_literal(literals[l]);
    const int blocks = tree.add_node(Op::Union, {leaf[0], leaf[1]});
    tree.root = tree.add_node(Op::Intersection, {blocks, leaf[2]});
    const Measures found = measure(boundary_of(tree, 6));
    CHECK(found.area == doctest::Approx(48).epsilon(1e-4));
    CHECK(found.volume == doctest::Approx(16).epsilon(1e-4));
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("coaxial cylinders of one radius are drawn once where they overlap") {
  Tree tree;
  Literal upper = cylinder(1, 2);
  upper.origin.z() = 1;
  const int a = tree.add_literal(cylinder(1, 2));
  const int b = tree.add_literal(upper);
  const int hull = tree.add_literal(box({-2, -2, -1}, {2, 2, 4}));
  const int both = tree.add_node(Op::Union, {a, b});
  tree.root = tree.add_node(Op::Intersection, {both, hull});
  const Measures found = measure(boundary_of(tree, 4));
  CHECK(found.area == doctest::Approx(2 * kPi * 3 + 2 * kPi).epsilon(2e-3));
}

TEST_CASE("no line divides a flush face, and its parts are shown as one literal") {
  // A block, a second one that goes on from it, and a tool that cuts the second one down.
  Tree tree;
  const int left = tree.add_literal(box({0, 0, 0}, {4, 2, 1}));
  const int right = tree.add_literal(box({4, 0, 0}, {6, 2, 2}));
  const int tool = tree.add_literal(box({4, -1, 1}, {7, 3, 3}));
  const int both = tree.add_node(Op::Union, {left, right});
  tree.root = tree.add_node(Op::Difference, {both, tool});
  const TreeBoundary boundary = boundary_of(tree, 6.4);
  const Measures m = measure(boundary);
  CHECK(m.volume == doctest::Approx(12).epsilon(1e-3));
  CHECK(m.area == doctest::Approx(40).epsilon(1e-3));
  double length = 0;
  for (const BoundaryLine& line : boundary.lines) {
    length += (line.to - line.from).norm();
    const Vec3 middle = (line.from + line.to) / 2;
    const bool is_at_end = std::abs(middle.x()) < 1e-3 || std::abs(middle.x() - 6) < 1e-3;
    const bool is_at_side = std::abs(middle.y()) < 1e-3 || std::abs(middle.y() - 2) < 1e-3;
    const bool is_at_level = std::abs(middle.z()) < 1e-3 || std::abs(middle.z() - 1) < 1e-3;
    CHECK(int{is_at_end} + int{is_at_side} + int{is_at_level} >= 2);
  }
  CHECK(length > 36);
  REQUIRE(boundary.shown.size() == 18);
  const auto of = [&](int l) {
    return std::vector<std::int32_t>(boundary.shown.begin() + 6 * l,
                                     boundary.shown.begin() + 6 * l + 6);
  };
  CHECK(of(0) == std::vector<std::int32_t>{0, 0, 0, 0, 0, 0});
  CHECK(of(1) == std::vector<std::int32_t>{1, 1, 0, 0, 0, 1});
  CHECK(of(2) == std::vector<std::int32_t>{2, 2, 2, 2, 0, 2});
}

TEST_CASE("the boundary is the same for any number of threads, and stops when asked") {
  Rng rng(3, 1);
  const Tree tree = testing::random_tree(rng, {.depth = 3});
  const TreeBoundary one = boundary_of(tree, 4, 1);
  const TreeBoundary four = boundary_of(tree, 4, 4);
  REQUIRE(one.corners.size() == four.corners.size());
  for (std::size_t i = 0; i < one.corners.size(); ++i) {
    CHECK(one.corners[i].position == four.corners[i].position);
  }
  CHECK(one.shown == four.shown);

  RunContext run;
  run.cancel = std::make_shared<CancelToken>();
  run.cancel->cancel();
  const auto stopped = tree_boundary(tree, 4, run);
  REQUIRE_FALSE(stopped);
  CHECK(stopped.error().code == ErrorCode::Cancelled);
  CHECK(boundary_of(Tree{}, 1).corners.empty());
}

}  // namespace
}  // namespace hewn
