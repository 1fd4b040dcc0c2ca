#include "core/segment/curvature/resolve_regions.h"

#include <numeric>

#include <doctest/doctest.h>

#include "tests/core/segment/curvature/stages.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

Segmentation resolve(const Mesh& mesh, const std::vector<FittedRegion>& regions) {
  const CurvatureStages s = run_stages(mesh);
  return *resolve_regions(s, regions, {}, {});
}

Surface level(double z) {
  Surface plane;
  plane.offset = z;
  return plane;
}

/// A flat square of cells in the plane z = 0.
Mesh sheet(int cells) {
  const Mesh box = solids::box({0, 0, -1}, {1, 1, 0}, cells);
  std::vector<Triangle> top;
  for (std::size_t t = 0; t < box.triangles.size(); ++t) {
    if (box.normals[t].z() > 0.5) top.push_back(box.triangles[t]);
  }
  return make_mesh(box.vertices, top);
}

TEST_CASE("overlap goes to the surface that fits best") {
  const Mesh mesh = sheet(4);
  std::vector<int> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  const Segmentation s = resolve(mesh, {{level(3e-4), all}, {level(0), all}});
  REQUIRE(s.groups.size() == 1);
  CHECK(std::abs(s.groups[0].surface.offset) < 1e-12);
}

TEST_CASE("two halves of one plane become one group, and gaps between them close") {
  const Mesh mesh = sheet(4);
  const int n = static_cast<int>(mesh.triangles.size());
  std::vector<int> first(10);
  std::iota(first.begin(), first.end(), 0);
  std::vector<int> last(10);
  std::iota(last.begin(), last.end(), n - 10);
  const Segmentation s = resolve(mesh, {{level(0), first}, {level(1e-9), last}});
  REQUIRE(s.groups.size() == 1);
  CHECK(static_cast<int>(s.groups[0].triangles.size()) == n);
}

TEST_CASE("without any region each face is still one group") {
  const Mesh mesh = solids::box({0, 0, 0}, {1, 2, 3}, 3);
  const Segmentation s = resolve(mesh, {});
  REQUIRE(s.groups.size() == 6);
  for (const FaceGroup& group : s.groups) {
    CHECK(group.is_fitted);
    CHECK(group.side == 1);
  }
}

TEST_CASE("what no primitive explains says so") {
  // A saddle: z = x^2 - 1.5 y^2.
  Mesh mesh = sheet(24);
  std::vector<Vec3> bent = mesh.vertices;
  for (Vec3& p : bent) {
    const double x = p.x() - 0.3;
    const double y = p.y() - 0.6;
    p.z() = x * x - 1.5 * y * y + 0.4 * x * x * x;
  }
  mesh = make_mesh(bent, mesh.triangles);
  const Segmentation s = resolve(mesh, {});
  double unexplained = 0;
  for (const FaceGroup& group : s.groups) unexplained += group.is_fitted ? 0 : group.area;
  CHECK(unexplained > 0.5 * mesh.total_area);
}

}  // namespace
}  // namespace hewn
