#include "core/compute/winding.h"

#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "tests/gpu/test_device.h"

namespace hewn::testing {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

/// By the solid angles of all triangles (van Oosterom and Strackee 1983).
int winding_number(const std::vector<Vec3>& vertices, const Triangles& triangles, const Vec3& p) {
  double sum = 0;
  for (const auto& t : triangles) {
    const Vec3 a = vertices[static_cast<std::size_t>(t[0])] - p;
    const Vec3 b = vertices[static_cast<std::size_t>(t[1])] - p;
    const Vec3 c = vertices[static_cast<std::size_t>(t[2])] - p;
    const double bottom = a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                          b.dot(c) * a.norm() + c.dot(a) * b.norm();
    sum += std::atan2(a.dot(b.cross(c)), bottom);
  }
  return static_cast<int>(std::lround(sum / (2 * kPi)));
}

struct Solid {
  std::vector<Vec3> vertices;
  Triangles triangles;

  void add_cube(const Vec3& low, double size) {
    const int first = static_cast<int>(vertices.size());
    for (int k = 0; k < 8; ++k) vertices.push_back(low + size * Vec3(k & 1, k >> 1 & 1, k >> 2));
    for (const auto& [a, b, c, d] : {std::array{0, 2, 3, 1},
                                     {4, 5, 7, 6},
                                     {0, 1, 5, 4},
                                     {2, 6, 7, 3},
                                     {0, 4, 6, 2},
                                     {1, 3, 7, 5}}) {
      triangles.push_back({first + a, first + b, first + c});
      triangles.push_back({first + a, first + c, first + d});
    }
  }
};

std::vector<Inside> found_inside(Device& device, const WindingTree& tree,
                                 const std::vector<Vec3>& points) {
  std::vector<Inside> inside(points.size(), Inside::Unsure);
  REQUIRE(tree.find_inside(device, points, inside, {}).has_value());
  return inside;
}

TEST_CASE("points lie inside a part as the sum of solid angles says") {
  const auto device = device_under_test();
  if (!device) return;
  const SamplePart part = read_sample_part();
  Box3 box;
  for (const Vec3& v : part.vertices) box.extend(v);
  Rng rng(31);
  std::vector<Vec3> points(2000);
  for (Vec3& p : points) {
    for (int k = 0; k < 3; ++k) p[k] = rng.uniform(box.lo[k] - 1, box.hi[k] + 1);
  }
  const WindingTree tree(part.vertices, part.triangles, true);
  const auto inside = found_inside(*device, tree, points);
  int inner = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    REQUIRE(inside[i] != Inside::Unsure);
    const bool is_inside = winding_number(part.vertices, part.triangles, points[i]) > 0;
    REQUIRE((inside[i] == Inside::Yes) == is_inside);
    inner += is_inside ? 1 : 0;
  }
  CHECK(inner > 100);
  auto plain = plain_device();
  CHECK(inside == found_inside(plain, tree, points));
}

TEST_CASE("solids that overlap count by orientation, others change sides at every crossing") {
  const auto device = device_under_test();
  if (!device) return;
  Solid solid;
  solid.add_cube({0, 0, 0}, 2);
  solid.add_cube({1, 1, 1}, 2);
  const std::vector<Vec3> points{{0.5, 0.6, 0.7}, {1.5, 1.6, 1.7}, {2.5, 2.6, 2.7}, {0.5, 2.5, 2}};
  using enum Inside;
  const auto found = [&](bool is_oriented) {
    return found_inside(*device, {solid.vertices, solid.triangles, is_oriented}, points);
  };
  CHECK(found(true) == std::vector{Yes, Yes, Yes, No});
  CHECK(found(false) == std::vector{Yes, No, Yes, No});
}

TEST_CASE("points on the surface and below an edge are not sure") {
  const auto device = device_under_test();
  if (!device) return;
  Solid solid;
  solid.add_cube({0, 0, 0}, 1);
  const WindingTree tree(solid.vertices, solid.triangles, true);
  const Vec3 up = Vec3(0.5773991, 0.3317541, 0.7460673).normalized();
  const std::vector<Vec3> points{
      {0.3, 0.4, 1}, {1, 1, 1}, Vec3(1, 1, 1) - 0.1 * up, {0.3, 0.4, 0.9}};
  const auto inside = found_inside(*device, tree, points);
  CHECK(inside[0] == Inside::Unsure);
  CHECK(inside[1] == Inside::Unsure);
  CHECK(inside[2] == Inside::Unsure);
  CHECK(inside[3] == Inside::Yes);
}

TEST_CASE("a mesh of nothing has no inside, and flat triangles change nothing") {
  const auto device = device_under_test();
  if (!device) return;
  const std::vector<Vec3> points{{0.3, 0.4, 0.5}, {3, 0, 0}};
  CHECK(found_inside(*device, {{}, {}, true}, points) == std::vector(2, Inside::No));
  CHECK(found_inside(*device, {{}, {}, true}, {}).empty());
  Solid solid;
  solid.add_cube({0, 0, 0}, 1);
  solid.triangles.push_back({0, 0, 1});
  solid.triangles.push_back({0, 1, 0});
  CHECK(found_inside(*device, {solid.vertices, solid.triangles, true}, points) ==
        std::vector{Inside::Yes, Inside::No});
}

TEST_CASE("inside tests stop when they are cancelled") {
  const auto device = device_under_test();
  if (!device) return;
  Solid solid;
  solid.add_cube({0, 0, 0}, 1);
  RunContext run;
  run.cancel->cancel();
  std::vector<Inside> inside(1);
  const std::vector<Vec3> points{{0.3, 0.4, 0.5}};
  const Result<void> done =
      WindingTree(solid.vertices, solid.triangles, true).find_inside(*device, points, inside, run);
  REQUIRE(!done);
  CHECK(done.error().code == ErrorCode::Cancelled);
}

}  // namespace
}  // namespace hewn::testing
