#include "core/csg/tree_ray.h"

#include <cmath>

#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

Literal cylinder(double radius, double top_radius, double height) {
  Literal literal;
  literal.kind = SolidKind::Cylinder;
  literal.radius = radius;
  literal.top_radius = top_radius;
  literal.height = height;
  return literal;
}

Tree single(Literal literal) {
  Tree tree;
  tree.root = tree.add_literal(std::move(literal));
  return tree;
}

std::vector<TreeInterval> cast(const Tree& tree, const Vec3& origin, const Vec3& direction) {
  TreeRayScratch scratch;
  return TreeRays(tree).cast(origin, direction, scratch);
}

/// Every stretch must be inside, every gap outside, and every end on the surface.
void check_against_distance(const Tree& tree, const Vec3& origin, const Vec3& direction) {
  const auto stretches = cast(tree, origin, direction);
  double from = 0;
  for (const TreeInterval& s : stretches) {
    REQUIRE(s.enter.t < s.leave.t);
    if (s.enter.t > from + 1e-6) {
      CHECK(tree.signed_distance(origin + (from + s.enter.t) / 2 * direction) > -1e-6);
    }
    if (s.enter.t > 0) {
      CHECK(std::abs(tree.signed_distance(origin + s.enter.t * direction)) < 1e-5);
    }
    if (s.leave.t < 1e6) {
      CHECK(std::abs(tree.signed_distance(origin + s.leave.t * direction)) < 1e-5);
    }
    if (s.leave.t - s.enter.t > 1e-6 && s.enter.t > 0 && s.leave.t < 1e6) {
      CHECK(tree.signed_distance(origin + (s.enter.t + s.leave.t) / 2 * direction) < 1e-6);
    }
    from = s.leave.t;
  }
}

TEST_CASE("a ray through a frustum meets its flank where the radius says") {
  const Tree tree = single(cylinder(4, 2, 10));
  const auto hits = cast(tree, Vec3(-10, 0, 5), Vec3::UnitX());
  REQUIRE(hits.size() == 1);
  CHECK(hits[0].enter.t == doctest::Approx(7));
  CHECK(hits[0].leave.t == doctest::Approx(13));
  CHECK(hits[0].enter.face == 0);
}

TEST_CASE("a ray along a frustum's axis meets its two caps") {
  const Tree tree = single(cylinder(4, 2, 10));
  const auto hits = cast(tree, Vec3(0, 1, -3), Vec3::UnitZ());
  REQUIRE(hits.size() == 1);
  CHECK(hits[0].enter.t == doctest::Approx(3));
  CHECK(hits[0].enter.face == 1);
  CHECK(hits[0].leave.t == doctest::Approx(13));
  CHECK(hits[0].leave.face == 2);
}

TEST_CASE("a ray across a torus passes its tube twice") {
  Literal torus;
  torus.kind = SolidKind::Torus;
  torus.major_radius = 5;
  torus.radius = 1;
  const auto hits = cast(single(torus), Vec3(-10, 0, 0), Vec3::UnitX());
  REQUIRE(hits.size() == 2);
  CHECK(hits[0].enter.t == doctest::Approx(4).epsilon(1e-5));
  CHECK(hits[0].leave.t == doctest::Approx(6).epsilon(1e-5));
  CHECK(hits[1].enter.t == doctest::Approx(14).epsilon(1e-5));
}

TEST_CASE("a hole splits a ray's stretch and bears the tool's index") {
  Tree tree;
  Literal block;
  block.size = Vec3(10, 10, 10);
  const int body = tree.add_literal(block);
  Literal tool = cylinder(2, 2, 14);
  tool.origin = Vec3(5, 5, -2);
  const int hole = tree.add_literal(tool);
  tree.root = tree.add_node(Op::Difference, {body, hole});
  const auto hits = cast(tree, Vec3(-1, 5, 5), Vec3::UnitX());
  REQUIRE(hits.size() == 2);
  CHECK(hits[0].leave.t == doctest::Approx(4));
  CHECK(hits[0].leave.literal == tree.nodes[hole].literal);
  CHECK(hits[1].enter.t == doctest::Approx(8));
  const Vec3 normal = TreeRays(tree).normal(hits[1].enter, Vec3(7, 5, 5), Vec3::UnitX());
  CHECK((normal + Vec3::UnitX()).norm() < 1e-9);
}

TEST_CASE("rays through random trees agree with the signed distance") {
  Rng rng(7);
  for (int round = 0; round < 60; ++round) {
    const Tree tree = testing::random_tree(rng, {});
    for (int k = 0; k < 20; ++k) {
      Vec3 origin;
      Vec3 direction;
      for (int c = 0; c < 3; ++c) {
        origin[c] = rng.uniform(-3, 3);
        direction[c] = rng.uniform(-1, 1);
      }
      if (direction.norm() < 0.1) continue;
      check_against_distance(tree, origin, direction.normalized());
    }
  }
}

TEST_CASE("in the ball looked at a nearby ray sees what a long one sees") {
  Rng rng(12);
  TreeRayScratch scratch;
  for (int i = 0; i < 40; ++i) {
    const Tree tree = testing::random_tree(rng, {});
    const TreeRays rays(tree);
    for (int k = 0; k < 50; ++k) {
      const Vec3 from = testing::random_point(rng, 2);
      const Vec3 d = testing::random_point(rng, 1).normalized();
      const double reach = rng.uniform(0.1, 1.0);
      std::vector<double> all, near;
      for (const TreeInterval& s : rays.cast(from, d, scratch)) {
        for (const double t : {s.enter.t, s.leave.t}) {
          if (t > 0 && t <= reach) all.push_back(t);
        }
      }
      const Nearby nearby = rays.look_around(from, reach, scratch);
      for (const TreeInterval& s : rays.cast_nearby(from, d, scratch)) {
        for (const double t : {s.enter.t, s.leave.t}) {
          if (t > 0 && t <= reach) near.push_back(t);
        }
      }
      REQUIRE(all == near);
      if (nearby == Nearby::Surface) continue;
      REQUIRE(all.empty());
      REQUIRE(tree.contains(from) == (nearby == Nearby::All));
    }
  }
}

}  // namespace
}  // namespace hewn
