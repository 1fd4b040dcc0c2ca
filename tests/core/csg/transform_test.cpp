#include <doctest/doctest.h>

#include "core/csg/literal.h"
#include "core/csg/tree_ray.h"
#include "random_tree.h"

namespace hewn {
namespace {

using testing::random_literal;
using testing::random_point;
using testing::random_rotation;

Affine3 similarity(Rng& rng) {
  Affine3 map(random_rotation(rng));
  const double scale = rng.uniform(0.3, 3);
  map.linear() *= scale;
  map.translation() = random_point(rng, 2);
  if (rng.coin()) map.linear().col(0) = -map.linear().col(0);
  return map;
}

Affine3 oblique(Rng& rng) {
  Affine3 map = similarity(rng);
  for (int k = 0; k < 3; ++k) {
    const double factor = rng.uniform(0.4, 2);
    map.linear().row(k) *= factor;
  }
  return map;
}

TEST_CASE("a moved, mirrored or stretched literal holds the moved points") {
  Rng rng(5);
  for (int i = 0; i < 400; ++i) {
    const Literal s = random_literal(rng);
    const Affine3 map = i % 2 == 0 ? similarity(rng) : oblique(rng);
    const Literal moved = transformed(s, map);
    const Box3 box = moved.bounds();
    for (int k = 0; k < 40; ++k) {
      const Vec3 x = random_point(rng, 2);
      const double d = s.signed_distance(x);
      if (std::abs(d) < 1e-6) continue;
      const Vec3 y = map * x;
      REQUIRE((moved.signed_distance(y) < 0) == (d < 0));
      if (d < 0) REQUIRE(box.contains(y, 1e-9));
    }
  }
}

TEST_CASE("maps along a literal's own axes need no stretch") {
  Literal tube;
  tube.kind = SolidKind::Cylinder;
  tube.radius = tube.top_radius = 2;
  tube.height = 3;
  Affine3 map = Affine3::Identity();
  map.linear() = Vec3(0.5, 0.5, -4).asDiagonal();
  const Literal moved = transformed(tube, map);
  CHECK_FALSE(moved.stretch.has_value());
  CHECK(moved.radius == 1);
  CHECK(moved.height == 12);
  map.linear() = Vec3(1, 2, 1).asDiagonal();
  CHECK(transformed(tube, map).stretch.has_value());
  map.linear() = Vec3(1, 2, -3).asDiagonal();
  Literal box;
  box.size = Vec3(1, 2, 3);
  CHECK(transformed(box, map).size == Vec3(1, 4, 9));
}

TEST_CASE("the distance of a stretched literal never exceeds the true one") {
  Literal ball;
  ball.kind = SolidKind::Sphere;
  ball.radius = 1;
  Affine3 map = Affine3::Identity();
  map.linear() = Vec3(1, 2, 5).asDiagonal();
  const Literal egg = transformed(ball, map);
  Rng rng(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3 x = random_point(rng, 6);
    const Vec3 u = random_point(rng, 1).normalized();
    const Vec3 on_surface = map * u;
    CHECK(std::abs(egg.signed_distance(x)) <= (x - on_surface).norm() + 1e-12);
  }
  CHECK(egg.signed_distance(Vec3(0, 0, 4.9)) < 0);
  CHECK(egg.signed_distance(Vec3(0, 2.1, 0)) > 0);
}

TEST_CASE("rays meet a stretched literal where its inside begins") {
  Rng rng(8);
  Tree tree;
  Literal s = random_literal(rng);
  while (s.kind == SolidKind::Polyhedron) s = random_literal(rng);
  tree.root = tree.add_literal(transformed(s, oblique(rng)));
  REQUIRE(tree.literals[0].stretch.has_value());
  const TreeRays rays(tree);
  TreeRayScratch scratch;
  const Box3 box = tree.bounds();
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 from = box.center() + random_point(rng, 1).normalized() * 20;
    const Vec3 aim = box.center() + random_point(rng, 0.2) * box.diagonal();
    const Vec3 d = (aim - from).normalized();
    for (const TreeInterval& stretch : rays.cast(from, d, scratch)) {
      ++hits;
      const double middle = (stretch.enter.t + stretch.leave.t) / 2;
      CHECK(tree.signed_distance(from + middle * d) < 0);
      const Vec3 normal = rays.normal(stretch.enter, from + stretch.enter.t * d, d);
      CHECK(normal.norm() == doctest::Approx(1));
      CHECK(normal.dot(d) <= 0);
    }
  }
  CHECK(hits > 50);
}

}  // namespace
}  // namespace hewn
