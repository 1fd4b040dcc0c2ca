#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "core/segment/segment.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

/// The curved groups of the feature above a plate that makes it small; each side of the plate is a
/// grid of `cells` x `cells` squares.
std::vector<FaceGroup> curved_groups_above_plate(const Mesh& feature, int cells = 1) {
  const Mesh plate = solids::box({-50, -50, -20}, {50, 50, -15}, cells);
  const Result<Segmentation> s = segment(solids::together(plate, feature), {}, RunContext{});
  REQUIRE(s.has_value());
  std::vector<FaceGroup> curved;
  for (const FaceGroup& g : s->groups) {
    if (g.surface.kind != SurfaceKind::Plane) curved.push_back(g);
  }
  return curved;
}

/// The walls of a bar along z over a closed polygon.
Mesh bar(const std::vector<Vec2>& outline, double height) {
  const int n = static_cast<int>(outline.size());
  std::vector<Vec3> vertices;
  for (const double z : {0.0, height}) {
    for (const Vec2& p : outline) vertices.emplace_back(p.x(), p.y(), z);
  }
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    triangles.push_back({i, j, n + j});
    triangles.push_back({i, n + j, n + i});
  }
  return make_mesh(vertices, triangles);
}

Vec2 on_circle(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

TEST_CASE("circles of nine sides and more are round, those of eight are not") {
  for (int sides = 8; sides <= 15; ++sides) {
    CAPTURE(sides);
    const auto curved = curved_groups_above_plate(solids::cylinder(3, 10, sides));
    REQUIRE(curved.size() == (sides > 8 ? 1 : 0));
    if (sides == 8) continue;
    CHECK(curved[0].surface.kind == SurfaceKind::Cylinder);
    CHECK(curved[0].surface.radius == doctest::Approx(3).epsilon(1e-5));
    CHECK(curved[0].triangles.size() == static_cast<std::size_t>(2 * sides));
  }
}

TEST_CASE("a coarse cylinder whose sides show keeps them") {
  constexpr int kSides = 13;
  constexpr double kDeepest = 2e-3 * 145;  // of the part's diagonal
  const double radius = kDeepest / (1 - std::cos(kPi / kSides));
  CHECK(curved_groups_above_plate(solids::cylinder(0.9 * radius, 10, kSides)).size() == 1);
  CHECK(curved_groups_above_plate(solids::cylinder(1.1 * radius, 10, kSides)).empty());
}

TEST_CASE("coarse cones and spheres are found whole") {
  for (const int sides : {10, 13}) {
    CAPTURE(sides);
    const auto cone = curved_groups_above_plate(solids::cone(4, 2, 2, sides));
    REQUIRE(cone.size() == 1);
    CHECK(cone[0].surface.kind == SurfaceKind::Cone);
    CHECK(cone[0].surface.half_angle_rad == doctest::Approx(kPi / 4).epsilon(1e-4));
    const auto ball = curved_groups_above_plate(solids::sphere(4, sides, sides / 2));
    REQUIRE(ball.size() == 1);
    CHECK(ball[0].surface.kind == SurfaceKind::Sphere);
    CHECK(ball[0].surface.radius == doctest::Approx(4).epsilon(1e-4));
  }
}

/// An outline with a corner around the origin: sides of a regular polygon, the last of them cut
/// off.
std::vector<Vec2> coarse_corner(double radius, int sides) {
  std::vector<Vec2> outline = {{-20, radius}, {-20, -20}, {radius, -20}};
  const double step = 2 * kPi / sides;
  int k = 0;
  for (; k * step < kPi / 2; ++k) outline.push_back(on_circle(radius, k * step));
  const Vec2 a = outline.back(), b = on_circle(radius, k * step);
  outline.push_back(a + (b - a) * (a.x() / (a.x() - b.x())));
  return outline;
}

TEST_CASE("a corner rounded with three coarse sides and a piece of a fourth is round") {
  const auto curved = curved_groups_above_plate(bar(coarse_corner(4, 13), 30));
  REQUIRE(curved.size() == 1);
  CHECK(curved[0].surface.kind == SurfaceKind::Cylinder);
  CHECK(curved[0].surface.radius == doctest::Approx(4).epsilon(1e-4));
  CHECK(curved[0].triangles.size() == 8);
}

TEST_CASE("coarse cylinders are found in a mesh that was resampled") {
  const auto curved = curved_groups_above_plate(solids::cylinder(3, 10, 13, 6), 20);
  REQUIRE(curved.size() == 1);
  CHECK(curved[0].surface.radius == doctest::Approx(3).epsilon(1e-5));
}

/// An outline with corners at these angles around the origin, and square ones.
std::vector<Vec2> cornered(double radius, const std::vector<double>& degrees) {
  std::vector<Vec2> outline = {{-20, -20}, {radius, -20}};
  for (const double d : degrees) outline.push_back(on_circle(radius, d * kPi / 180));
  outline.emplace_back(-20, outline.back().y());
  return outline;
}

TEST_CASE("three sides alone are round when they are a regular polygon's") {
  const double step = 360.0 / 13;
  const auto curved =
      curved_groups_above_plate(bar(cornered(4, {0, step, 2 * step, 3 * step}), 30));
  REQUIRE(curved.size() == 1);
  CHECK(curved[0].surface.radius == doctest::Approx(4).epsilon(1e-5));
  CHECK(curved[0].triangles.size() == 6);
  CHECK(curved_groups_above_plate(bar(cornered(4, {0, 25, 55, 83}), 30)).empty());
}

TEST_CASE("a flat face and slivers beside it are no cylinder, though one meets their corners") {
  std::vector<Vec2> outline = {{-6.1, -20}, {6.1, -20}};
  for (const double degrees : {24, 22, 20, -20, -22, -24}) {
    outline.push_back(on_circle(15, (90 - degrees) * kPi / 180));
  }
  CHECK(curved_groups_above_plate(bar(outline, 10)).empty());
}

}  // namespace
}  // namespace hewn
