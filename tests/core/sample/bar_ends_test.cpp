#include "core/sample/bar_ends.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <doctest/doctest.h>

#include "core/mesh/load.h"
#include "tests/support/part_problem.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

Mesh spoked_wheel() {
  auto loaded = load_mesh(HEWN_TEST_DATA "/spoked_wheel.off", {}, {});
  REQUIRE(loaded);
  return std::move(loaded->mesh);
}

TEST_CASE("every spoke gets a plane in the hub and one in the rim") {
  solids::PartProblem part(spoked_wheel());
  const std::vector<Halfspace> ends = bar_ends(part.space, part.surfaces);
  CHECK(ends.size() == 10);
  for (const Halfspace& h : ends) {
    CHECK(h.is_separating);
    REQUIRE(h.direction >= 0);
    CHECK(h.surface.axis == part.surfaces.directions[static_cast<std::size_t>(h.direction)]);
    // Spokes are tilted by five degrees.
    CHECK(std::abs(h.surface.axis.z()) == doctest::Approx(std::sin(kPi / 36)).epsilon(1e-3));
    // Where the plane meets the spoke's middle height, there is solid around it.
    const Vec3 radial = (h.surface.axis - Vec3(0, 0, h.surface.axis.z())).normalized();
    const double at = (h.surface.offset - 11 * h.surface.axis.z()) / h.surface.axis.dot(radial);
    const Vec3 p = at * radial + Vec3(0, 0, 11);
    const double radius = std::hypot(p.x(), p.y());
    CHECK(((radius > 6 && radius < 14) || (radius > 44 && radius < 50)));
    CHECK((*part.space.label)(p) == Label::Inside);
  }
}

TEST_CASE("rods get a plane where they are hidden, holes where they open into a bore") {
  auto loaded = load_mesh(HEWN_TEST_DATA "/hub_with_rods.off", {}, {});
  REQUIRE(loaded);
  solids::PartProblem part(std::move(loaded->mesh));
  const std::vector<Halfspace> ends = bar_ends(part.space, part.surfaces);
  CHECK(ends.size() == 7);
  // The hole leans by 65 degrees, the rods by 83.
  CHECK(std::count_if(ends.begin(), ends.end(), [](const Halfspace& h) {
          return std::abs(std::abs(h.surface.axis.z()) - std::cos(65 * kPi / 180)) < 1e-3;
        }) == 1);
}

TEST_CASE("an arm gets a plane in the hub although a face across it ends it outside") {
  auto loaded = load_mesh(HEWN_TEST_DATA "/rotor.off", {}, {});
  REQUIRE(loaded);
  solids::PartProblem part(std::move(loaded->mesh));
  const std::size_t directions = part.surfaces.directions.size();
  const std::vector<Halfspace> ends = bar_ends(part.space, part.surfaces);
  CHECK(ends.size() == 5);
  CHECK(part.surfaces.directions.size() == directions);
  // Nothing tells the place but that it is within the hub.
  for (const Halfspace& h : ends) CHECK(std::abs(h.surface.offset) == 5);
}

TEST_CASE("the sides of a blade need not meet at right angles") {
  auto loaded = load_mesh(HEWN_TEST_DATA "/fan.off", {}, {});
  REQUIRE(loaded);
  solids::PartProblem part(std::move(loaded->mesh));
  const std::vector<Halfspace> ends = bar_ends(part.space, part.surfaces);
  CHECK(std::count_if(ends.begin(), ends.end(), [](const Halfspace& h) {
          return std::abs(h.surface.offset) == 10 && std::abs(h.surface.axis.z()) < 1e-9;
        }) == 5);
}

TEST_CASE("bars that end in the open get no planes") {
  for (const Mesh& mesh : {solids::box({0, 0, 0}, {9, 2, 1}), solids::cylinder(2, 9, 6),
                           solids::plate_with_hole({10, 8, 2}, 2, 24)}) {
    solids::PartProblem part(mesh);
    const std::size_t directions = part.surfaces.directions.size();
    CHECK(bar_ends(part.space, part.surfaces).empty());
    CHECK(part.surfaces.directions.size() == directions);
  }
}

}  // namespace
}  // namespace hewn
