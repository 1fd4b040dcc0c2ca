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

/// A hexagon of inscribed radius 2 around (5, 1), its sides alternately turned, and planes across.
SurfaceSet hexagon() {
  SurfaceSet set;
  for (int k = 0; k < 3; ++k) {
    const double angle = kPi * (2 * k + 1) / 6;
    set.directions.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  set.directions.push_back(Vec3::UnitZ());
  for (int k = 0; k < 8; ++k) {
    Halfspace h;
    h.direction = k < 6 ? k / 2 : 3;
    h.tolerance = 1e-3;
    h.surface.axis = set.directions[h.direction];
    h.surface.offset = h.surface.axis.dot(Vec3(5, 1, 0)) + (k % 2 == 0 ? 2 : -2);
    set.halfspaces.push_back(h);
  }
  return set;
}

const std::vector<TermLiteral> kHexagon = {{0, true},  {1, false}, {2, true},
                                           {3, false}, {4, true},  {5, false}};

TEST_CASE("the sides of a regular prism share one primitive, with its ends") {
  const Combinability c(hexagon());
  CHECK(term_cost(kHexagon, c) == 1);
  std::vector<TermLiteral> closed = kHexagon;
  closed.push_back({6, true});
  closed.push_back({7, false});
  CHECK(term_cost(closed, c) == 1);
  closed.erase(closed.begin());
  CHECK(term_cost(closed, c) > 1);
}

TEST_CASE("a side that is off by more than its tolerance makes no prism") {
  SurfaceSet moved = hexagon();
  moved.halfspaces[3].surface.offset += 2e-3;
  CHECK(term_cost(kHexagon, Combinability(moved)) == 3);
  SurfaceSet near = hexagon();
  near.halfspaces[3].surface.offset += 5e-4;
  CHECK(term_cost(kHexagon, Combinability(near)) == 1);
}

TEST_CASE("a term without literals is a box") {
  CHECK(term_cost({}, Combinability(example())) == 1);
}

}  // namespace
}  // namespace hewn
