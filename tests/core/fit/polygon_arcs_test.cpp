#include "core/fit/polygon_arcs.h"

#include <cmath>

#include <doctest/doctest.h>

#include "core/fit/surface_set.h"
#include "tests/core/fit/fitted_arc.h"

namespace hewn {
namespace {

constexpr double kExact = 1e-5;
const Vec3 kCenter(14, 2, 0);

/// A place on the outline of a polygon with its corners on a circle about `kCenter`, `side` sides
/// around from the first one's beginning.
Vec3 on_outline(double radius, int sides, double side, double z) {
  const double step = 2 * kPi / sides;
  const double whole = std::floor(side);
  const auto corner = [&](double k) {
    return Vec3(kCenter + Vec3(radius * std::cos(k * step), radius * std::sin(k * step), z));
  };
  return corner(whole) + (side - whole) * (corner(whole + 1) - corner(whole));
}

/// A cylinder along z, fitted to all vertices of an arc.
FitItem arc_item(double radius, int sides, const std::vector<double>& places) {
  std::vector<Vec3> points;
  for (const double z : {0.0, 5.0}) {
    for (const double p : places) points.push_back(on_outline(radius, sides, p, z));
  }
  return testing::fitted_arc(std::move(points), kCenter, radius);
}

void settle(FitItem& item) {
  std::vector<FitItem> items{item};
  settle_polygon_arcs(items, {Vec3::UnitZ()}, kExact, 0);
  item = items[0];
}

bool has_circle(const FitItem& item, double radius) {
  const Vec3 off = item.surface.point - kCenter;
  return off.head<2>().norm() < 20 * kExact && std::abs(item.surface.radius - radius) < 20 * kExact;
}

TEST_CASE("a flute cut off on both ends has the circle of its corners") {
  for (const int first : {0, 5, 8, 14}) {
    const double f = first;
    FitItem item = arc_item(3, 16, {f + 0.08, f + 1, f + 2, f + 3, f + 3.9});
    CHECK_FALSE(has_circle(item, 3));  // the ends drag the fit
    settle(item);
    CHECK(has_circle(item, 3));
    CHECK(item.points.size() == 6);
  }
}

TEST_CASE("vertices on the sides in between are no corners") {
  FitItem item = arc_item(3, 24, {0.5, 1, 1.25, 1.7, 2, 3, 4, 4.5, 5, 5.3});
  settle(item);
  CHECK(has_circle(item, 3));
}

TEST_CASE("an arc keeps its fit where the corners are no regular polygon's") {
  // Unequal sides; too few corners; an end beside the side; one too far along it.
  FitItem unequal = arc_item(3, 16, {0.1, 1, 2, 3, 3.9});
  unequal.points[2].x() += 0.02;
  FitItem few = arc_item(3, 16, {0.3, 1, 2, 2.6});
  FitItem beside = arc_item(3, 16, {0.1, 1, 2, 3, 3.9});
  for (const std::size_t k : {std::size_t{0}, std::size_t{5}}) beside.points[k].x() += 0.01;
  FitItem beyond = arc_item(3, 16, {1, 1.5, 2.5, 3.5, 4.2});
  for (FitItem item : {unequal, few, beside, beyond}) {
    const Surface before = item.surface;
    settle(item);
    CHECK(item.surface.radius == before.radius);
    CHECK(item.surface.point == before.point);
  }
}

TEST_CASE("with sides hardly longer than vertices are off nothing is concluded") {
  FitItem item = arc_item(1e-4, 16, {0.1, 1, 2, 3, 3.9});
  item.sigma = 1;
  const double before = item.surface.radius;
  settle(item);
  CHECK(item.surface.radius == before);
}

}  // namespace
}  // namespace hewn
