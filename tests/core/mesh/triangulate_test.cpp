#include <doctest/doctest.h>

#include "core/mesh/raw_mesh.h"

namespace hewn {
namespace {

double area_of(const std::vector<Vec3>& vertices) {
  std::vector<int> loop;
  for (int i = 0; i < static_cast<int>(vertices.size()); ++i) loop.push_back(i);
  std::vector<Triangle> triangles;
  CHECK(triangulate_polygon(vertices, loop, triangles) == static_cast<int>(loop.size()) - 2);
  const Mesh mesh = make_mesh(vertices, triangles);
  double signed_area = 0;  // against the first: overlapping triangles would not cancel
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    signed_area += mesh.areas[t];
  }
  return signed_area;
}

TEST_CASE("a star is covered exactly once") {
  std::vector<Vec3> star;
  double wanted = 0;
  for (int i = 0; i < 20; ++i) {
    const double r = i % 2 == 0 ? 2 : 0.7;
    const double angle = i * kPi / 10;
    star.emplace_back(r * std::cos(angle), r * std::sin(angle), 3);
    wanted += 0.5 * 2 * 0.7 * std::sin(kPi / 10);
  }
  CHECK(area_of(star) == doctest::Approx(wanted));
}

TEST_CASE("corners in a row are kept without covering anything twice") {
  CHECK(area_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}}) ==
        doctest::Approx(4));
}

}  // namespace
}  // namespace hewn
