#include "core/csg/literal.h"

#include <cmath>

#include <doctest/doctest.h>

#include "core/csg/bounds_table.h"
#include "random_tree.h"

namespace hewn {
namespace {

Literal plain(SolidKind kind) {
  Literal s;
  s.kind = kind;
  s.size = Vec3(2, 4, 6);
  s.height = 3;
  s.radius = 1;
  s.top_radius = 1;
  s.major_radius = 2;
  return s;
}

TEST_CASE("distances at hand-picked points are exact") {
  const Literal box = plain(SolidKind::Box);
  CHECK(box.signed_distance({1, 2, 3}) == doctest::Approx(-1));
  CHECK(box.signed_distance({5, 8, 3}) == doctest::Approx(5));
  Literal cylinder = plain(SolidKind::Cylinder);
  CHECK(cylinder.signed_distance({0, 0, 1}) == doctest::Approx(-1));
  CHECK(cylinder.signed_distance({4, 0, 7}) == doctest::Approx(5));
  cylinder.top_radius = 0;
  cylinder.height = 1;
  CHECK(cylinder.signed_distance({1, 0, 1}) == doctest::Approx(std::sqrt(0.5)));
  CHECK(cylinder.signed_distance({0, 0, 2}) == doctest::Approx(1));
  CHECK(plain(SolidKind::Sphere).signed_distance({0, 3, 4}) == doctest::Approx(4));
  Literal nut = plain(SolidKind::Prism);  // corners at x = +-2 / sqrt(3), sides at y = +-1
  nut.sides = 6;
  CHECK(nut.signed_distance({0, 0, 1.5}) == doctest::Approx(-1));
  CHECK(nut.signed_distance({0, 3, 1}) == doctest::Approx(2));
  CHECK(nut.signed_distance({2 / std::sqrt(3) + 3, 0, 7}) == doctest::Approx(5));
  const Literal torus = plain(SolidKind::Torus);
  CHECK(torus.signed_distance({0, 2, 0}) == doctest::Approx(-1));
  CHECK(torus.signed_distance({0, 0, 0}) == doctest::Approx(1));
}

TEST_CASE("a spindle torus is solid on its axis") {
  Literal torus = plain(SolidKind::Torus);
  torus.major_radius = 0.5;
  CHECK(torus.signed_distance({0, 0, 0}) < 0);
  CHECK(torus.signed_distance({0, 0, 0.9}) > 0);
}

TEST_CASE("local coordinates are rotated first and shifted after") {
  Literal s = plain(SolidKind::Box);
  s.rotation = Eigen::AngleAxisd(kPi / 2, Vec3::UnitZ()).toRotationMatrix();
  s.origin = Vec3(10, 0, 0);
  CHECK((s.to_world(Vec3::Zero()) - Vec3(0, 10, 0)).norm() < 1e-12);
  CHECK(s.to_local(s.to_world(Vec3(1, 2, 3))).isApprox(Vec3(1, 2, 3)));
  CHECK(s.signed_distance({-2, 11, 3}) == doctest::Approx(-1));
}

TEST_CASE("no point further out than its distance is inside, and none further in outside") {
  Rng rng(11);
  for (int i = 0; i < 300; ++i) {
    const Literal s = testing::random_literal(rng);
    for (int k = 0; k < 30; ++k) {
      const Vec3 x = testing::random_point(rng, 3);
      const double d = s.signed_distance(x);
      const Vec3 y = x + testing::random_point(rng, 1).normalized() * (0.999 * std::abs(d));
      CHECK((s.signed_distance(y) < 0) == (d < 0));
    }
  }
}

TEST_CASE("the bounds hold the solid and touch it") {
  Rng rng(12);
  for (int i = 0; i < 200; ++i) {
    const Literal s = testing::random_literal(rng);
    const Box3 box = s.bounds();
    for (int k = 0; k < 200; ++k) {
      const Vec3 x = testing::random_point(rng, 4);
      if (s.signed_distance(x) < 0) CHECK(box.contains(x, 1e-12));
    }
    // Each side of a tight box has a point of the solid: its distance falls to zero there.
    for (int axis = 0; axis < 3; ++axis) {
      double least = kInfinity;
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      for (int k = 0; k < 41 * 41; ++k) {
        const int row = k / 41;
        Vec3 x = box.lo;
        x[u] += box.size()[u] * (k % 41) / 40;
        x[v] += box.size()[v] * row / 40;
        least = std::min(least, s.signed_distance(x));
      }
      CHECK(least >= -1e-12);
      CHECK(least < 0.1);
    }
  }
}

TEST_CASE("a literal contains the points whose distance is negative, whatever its bounds tell") {
  Rng rng(13);
  for (int i = 0; i < 200; ++i) {
    Literal s = testing::random_literal(rng);
    if (s.kind == SolidKind::Box && rng.coin()) {
      s.stretch = Stretch::of(Mat3::Identity() + 0.2 * testing::random_rotation(rng));
    }
    const LiteralBounds bounds(s);
    for (int k = 0; k < 100; ++k) {
      const Vec3 p = testing::random_point(rng, 2.5);
      const bool is_inside = s.signed_distance(p) < 0;
      REQUIRE(s.contains(p) == is_inside);
      REQUIRE(literal_contains(s, bounds, p) == is_inside);
    }
  }
}

TEST_CASE("bounds stand in for distances beyond the reach only") {
  Rng rng(77);
  int skipped_inside = 0;
  for (int i = 0; i < 200; ++i) {
    const Literal s = testing::random_literal(rng);
    const LiteralBounds bounds(s);
    for (int k = 0; k < 50; ++k) {
      const Vec3 p = testing::random_point(rng, 2);
      const double reach = rng.uniform(0, 0.5);
      const double exact = s.signed_distance(p);
      const double within = distance_within(s, bounds, p, reach);
      if (std::isfinite(within)) {
        REQUIRE(within == exact);
        continue;
      }
      REQUIRE((within < 0) == (exact < 0));
      REQUIRE(std::abs(exact) > reach);
      skipped_inside += within < 0 ? 1 : 0;
    }
  }
  CHECK(skipped_inside > 0);
}

TEST_CASE("a table of bounds leaves out only literals that are further off than their reach") {
  Rng rng(78);
  std::vector<Literal> literals;
  std::vector<LiteralBounds> bounds;
  std::vector<double> reach;
  for (int i = 0; i < 37; ++i) {
    literals.push_back(testing::random_literal(rng));
    bounds.emplace_back(literals.back());
    reach.push_back(i % 3 == 0 ? 0 : rng.uniform(0, 0.3));
  }
  const BoundsTable table(bounds, reach);
  std::size_t visited = 0;
  for (int i = 0; i < 500; ++i) {
    Vec3 p = testing::random_point(rng, 2);
    // On the very bounds of one literal, too.
    if (i % 2 == 0) p[i % 3] = bounds[static_cast<std::size_t>(i) % bounds.size()].box.lo[i % 3];
    std::vector<char> is_near(literals.size(), 0);
    table.visit_near(p, [&](std::size_t k) {
      is_near[k] = 1;
      ++visited;
      return true;
    });
    for (std::size_t k = 0; k < literals.size(); ++k) {
      if (!is_near[k]) REQUIRE(distance_within(literals[k], bounds[k], p, reach[k]) > reach[k]);
    }
  }
  CHECK(visited < 500 * literals.size());
}

/// Whether the whole line meets the box.
bool line_meets(const Box3& box, const Vec3& origin, const Vec3& direction) {
  double enter = -kInfinity;
  double leave = kInfinity;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0) {
      if (origin[k] < box.lo[k] || origin[k] > box.hi[k]) return false;
      continue;
    }
    const double a = (box.lo[k] - origin[k]) / direction[k];
    const double b = (box.hi[k] - origin[k]) / direction[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

TEST_CASE("a table of bounds leaves out only literals that a line passes by") {
  for (const double scale : {1.0, 1e-4, 1e5}) {
    Rng rng(79);
    std::vector<LiteralBounds> bounds;
    for (int i = 0; i < 37; ++i) {
      bounds.emplace_back(testing::random_literal(rng));
      bounds.back().box.lo *= scale;
      bounds.back().box.hi *= scale;
      bounds.back().slack *= scale;
    }
    bounds[5].box = Box3{};
    const BoundsTable table(bounds, std::vector<double>(bounds.size(), 0));
    std::size_t visited = 0;
    std::size_t met = 0;
    for (int i = 0; i < 2000; ++i) {
      Vec3 direction = testing::random_point(rng, 1).normalized();
      Vec3 point = testing::random_point(rng, 1) * scale;
      const Box3& box = bounds[static_cast<std::size_t>(i) % bounds.size()].box;
      const int axis = i % 3;
      if (i % 4 == 1 && !box.is_empty()) point[axis] = box.lo[axis];
      if (i % 4 <= 1) direction[axis] = i % 8 == 0 ? 1e-12 : 0;  // along a face, or nearly so
      if (i % 16 == 1) direction = Vec3::Unit((axis + 1) % 3);
      const Vec3 origin = point - 7 * scale * direction;
      std::vector<char> is_met(bounds.size(), 0);
      table.visit_met(origin, direction, [&](std::size_t k) { is_met.at(k) = 1; });
      CHECK_FALSE(is_met[5]);
      for (std::size_t k = 0; k < bounds.size(); ++k) {
        const bool meets =
            !bounds[k].box.is_empty() && line_meets(bounds[k].box, origin, direction);
        if (meets) REQUIRE(is_met[k]);
        visited += is_met[k];
        met += meets ? 1U : 0U;
      }
    }
    // Few that are not met, at that.
    CHECK(met > 5000);
    CHECK(visited < met + met / 20);
  }
}

TEST_CASE("a polyhedron's query answers as the sum over its triangles does") {
  Rng rng(13);
  const auto mesh = std::make_shared<const Mesh>(testing::tetrahedron(1.5));
  const Literal quick = polyhedron_literal(mesh);
  Literal plain = quick;
  plain.polyhedron_query.reset();
  for (int i = 0; i < 300; ++i) {
    const Vec3 x = testing::random_point(rng, 2);
    CHECK(quick.signed_distance(x) == doctest::Approx(plain.signed_distance(x)).epsilon(1e-5));
  }
}

}  // namespace
}  // namespace hewn
