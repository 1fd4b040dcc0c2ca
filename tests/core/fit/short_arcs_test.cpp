#include "core/fit/short_arcs.h"

#include <cmath>

#include <doctest/doctest.h>

#include "core/fit/surface_set.h"
#include "tests/core/fit/fitted_arc.h"

namespace hewn {
namespace {

constexpr double kDiagonal = 40;
constexpr double kExact = 1e-5;

Vec3 at(const Vec3& center, double radius, double degrees, double z) {
  const double a = degrees * kPi / 180;
  return center + Vec3(radius * std::cos(a), radius * std::sin(a), z);
}

/// A cylinder along z, fitted to what the vertices of an arc tell.
FitItem arc_item(const Vec3& center, double radius, const std::vector<double>& on_circle,
                 const std::vector<double>& on_chords, double depth = 0.015) {
  std::vector<Vec3> points;
  for (const double z : {0.0, 6.0}) {
    for (const double a : on_circle) points.push_back(at(center, radius, a, z));
    for (const double a : on_chords) points.push_back(at(center, radius - depth, a, z));
  }
  return testing::fitted_arc(std::move(points), center, radius);
}

/// What lies between the teeth of a gear, `step` degrees apart.
std::vector<FitItem> gear_ground(double step) {
  std::vector<FitItem> items;
  for (double a = 0; a < 360; a += step) {
    items.push_back(
        arc_item(Vec3::Zero(), 16, {a + 11.25, a + 16.875, a + 22.5}, {a + 7.2, a + 22.8}));
  }
  return items;
}

void settle(std::vector<FitItem>& items) {
  settle_short_arcs(items, {Vec3::UnitZ()}, SnapRule({}, kDiagonal, kExact / 5), kExact);
}

bool is_on_axis(const FitItem& item, double radius) {
  const Vec3& p = item.surface.point;
  return std::hypot(p.x(), p.y()) < kExact && std::abs(item.surface.radius - radius) < kExact;
}

TEST_CASE("the ground between teeth takes the bore's axis and its own circle") {
  std::vector<FitItem> items = gear_ground(90);
  CHECK_FALSE(is_on_axis(items[0], 16));  // chords drag each arc's own fit
  items.push_back(arc_item(Vec3::Zero(), 5, {0, 45, 90, 135, 180, 225, 270, 315}, {}));
  settle(items);
  for (std::size_t i = 0; i < 4; ++i) CHECK(is_on_axis(items[i], 16));
  CHECK(is_on_axis(items[4], 5));
}

TEST_CASE("without a bore, the arcs together tell their axis") {
  std::vector<FitItem> items = gear_ground(30);
  settle(items);
  for (const FitItem& item : items) CHECK(is_on_axis(item, 16));
}

TEST_CASE("an arc with two vertices on a circle joins those that three place, and only those") {
  std::vector<FitItem> items = gear_ground(90);
  items.push_back(arc_item(Vec3::Zero(), 5, {0, 45, 90, 135, 180, 225, 270, 315}, {}));
  items.push_back(arc_item(Vec3::Zero(), 16, {50, 55}, {47, 58, 60}));
  items.push_back(arc_item(Vec3::Zero(), 14, {50, 55}, {47, 58, 60}));
  settle(items);
  CHECK(is_on_axis(items[5], 16));
  CHECK_FALSE(is_on_axis(items[6], 14));
}

TEST_CASE("an arc that fits its vertices on chords almost exactly still finds its circle") {
  // The lands of a knurled wheel of 96 facets, cut 0.4 degrees behind a corner at either end.
  const double half = 3.75 / 2 * kPi / 180;
  const double depth = 20 * (1 - std::cos(half) / std::cos(half - 0.4 * kPi / 180));
  std::vector<FitItem> items;
  items.push_back(arc_item(Vec3::Zero(), 4, {0, 45, 90, 135, 180, 225, 270, 315}, {}));
  for (const double a : {0.0, 90.0, 180.0, 270.0}) {
    items.push_back(
        arc_item(Vec3::Zero(), 20, {a + 11.25, a + 15, a + 18.75}, {a + 7.9, a + 22.1}, depth));
  }
  CHECK(items[1].sigma < depth / 5);
  CHECK_FALSE(is_on_axis(items[1], 20));
  settle(items);
  for (std::size_t i = 1; i < items.size(); ++i) CHECK(is_on_axis(items[i], 20));
}

TEST_CASE("a rounding keeps its own axis") {
  std::vector<FitItem> items;
  items.push_back(arc_item(Vec3::Zero(), 5, {0, 45, 90, 135, 180, 225, 270, 315}, {}));
  items.push_back(arc_item(Vec3(10, 10, 0), 4, {0, 15, 30, 45, 60, 75, 90}, {}));
  items.push_back(arc_item(Vec3(-10, 10, 0), 4, {91, 110, 133}, {88, 136}));
  const Vec3 loose = items[2].surface.point;
  settle(items);
  CHECK((items[1].surface.point - Vec3(10, 10, 0)).head<2>().norm() < kExact);
  CHECK(items[2].surface.point == loose);
}

}  // namespace
}  // namespace hewn
