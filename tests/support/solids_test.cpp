#include "tests/support/solids.h"

#include <doctest/doctest.h>

namespace hewn {
namespace {

/// Area of the regular polygon with `sides` corners on a circle.
double polygon_area(double radius, int sides) {
  return 0.5 * sides * radius * radius * std::sin(2 * kPi / sides);
}

TEST_CASE("every solid is closed and has the volume of its polyhedron") {
  const auto check = [](const Mesh& mesh, double volume) {
    CHECK(solids::is_closed(mesh));
    CHECK(mesh.volume == doctest::Approx(volume).epsilon(1e-9));
    const Mesh moved = solids::transformed(mesh, solids::oblique_transform());
    CHECK(moved.volume == doctest::Approx(volume).epsilon(1e-9));
  };
  check(solids::box({0, 1, 2}, {1, 3, 5}, 3), 6);
  check(solids::cylinder(2, 3, 24, 2), 3 * polygon_area(2, 24));
  const double base = polygon_area(2, 24);
  check(solids::cone(2, 0, 3, 24, 4), base);
  check(solids::cone(2, 1, 3, 24), base * (1 + 0.5 + 0.25));
  check(solids::plate_with_hole({4, 3, 1}, 0.5, 24, 2), 12 - polygon_area(0.5, 24));
  check(solids::block_with_fillet({3, 2, 1}, 0.5, 6), 6 - 0.25 + polygon_area(0.5, 24) / 4);
}

TEST_CASE("round solids approach the true volume from below") {
  const auto check = [](const Mesh& mesh, double volume) {
    CHECK(solids::is_closed(mesh));
    CHECK(mesh.volume < volume);
    CHECK(mesh.volume > 0.97 * volume);
  };
  check(solids::sphere(2, 48, 24), 4.0 / 3 * kPi * 8);
  check(solids::torus(3, 1, 64, 32), 2 * kPi * kPi * 3);
  check(solids::capsule(1, 4, 48, 12), kPi * 4 + 4.0 / 3 * kPi);
}

TEST_CASE("an open mesh is not taken for a closed one") {
  const Mesh box = solids::box({0, 0, 0}, {1, 1, 1});
  std::vector<Triangle> triangles(box.triangles.begin() + 1, box.triangles.end());
  CHECK_FALSE(solids::is_closed(make_mesh(box.vertices, triangles)));
}

}  // namespace
}  // namespace hewn
