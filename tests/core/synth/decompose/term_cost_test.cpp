#include "core/synth/decompose/term_cost.h"

#include <doctest/doctest.h>

namespace hewn {
namespace {

/// Planes x = 0, y = 0, z = 0 and one at 45 degrees; a cylinder along z, a sphere.
SurfaceSet example() {
  SurfaceSet set;
  set.directions = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), Vec3(1, 1, 0).normalized()};
  for (int d = 0; d < 4; ++d) {
    Halfspace h;
    h.direction = d;
    h.surface.axis = set.directions[d];
    set.halfspaces.push_back(h);
  }
  Halfspace cylinder;
  cylinder.direction = 2;
  cylinder.surface.kind = SurfaceKind::Cylinder;
  cylinder.surface.radius = 1;
  set.halfspaces.push_back(cylinder);
  Halfspace sphere;
  sphere.surface.kind = SurfaceKind::Sphere;
  sphere.surface.radius = 1;
  set.halfspaces.push_back(sphere);
  return set;
}

constexpr int kX = 0, kY = 1, kZ = 2, kOblique = 3, kCylinder = 4, kSphere = 5;

TEST_CASE("planes at right angles share one box, oblique ones need another") {
  const Combinability c(example());
  CHECK(term_cost({{kX, true}, {kY, false}, {kZ, true}}, c) == 1);
  CHECK(term_cost({{kX, true}, {kOblique, true}}, c) == 2);
  CHECK(term_cost({{kZ, true}, {kOblique, true}}, c) == 1);
}

TEST_CASE("planes across the axis cap a cylinder for free, others do not") {
  const Combinability c(example());
  CHECK(term_cost({{kCylinder, true}, {kZ, true}}, c) == 1);
  CHECK(term_cost({{kCylinder, true}, {kX, true}}, c) == 2);
  CHECK(term_cost({{kSphere, true}, {kZ, true}}, c) == 2);
}

TEST_CASE("the outside of a curved surface needs something to be taken from") {
  const Combinability c(example());
  CHECK(term_cost({{kCylinder, false}}, c) == 2);
  const auto plans = plan_primitives({{kCylinder, false}, {kZ, true}}, c);
  REQUIRE(plans.size() == 2);
  CHECK(plans[0].is_positive() != plans[1].is_positive());
}

TEST_CASE("a term without literals is a box") {
  CHECK(term_cost({}, Combinability(example())) == 1);
}

}  // namespace
}  // namespace hewn
