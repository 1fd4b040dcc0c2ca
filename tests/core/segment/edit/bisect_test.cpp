#include "core/segment/edit/bisect.h"

#include <numeric>

#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "tests/core/segment/edit/known_groups.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

struct Part {
  Mesh mesh;
  Segmentation segmentation;
};

Part plate() {
  Part part;
  part.mesh = solids::plate_with_hole({4, 3, 1}, 0.8, 32, 2);
  std::vector<Surface> surfaces = box_sides({-2, -1.5, -0.5}, {2, 1.5, 0.5});
  surfaces.push_back(cylinder_surface(Vec3::Zero(), Vec3::UnitZ(), 0.8));
  part.segmentation = segment_by_surfaces(part.mesh, surfaces);
  return part;
}

EditedSegmentation bisect(const Part& part, const std::vector<int>& groups, const CutPlane& plane) {
  auto result = bisect_groups(part.mesh, part.segmentation, groups, plane, {}, {});
  REQUIRE(result.has_value());
  return std::move(*result);
}

std::vector<int> all_groups(const Part& part) {
  std::vector<int> groups(part.segmentation.groups.size());
  std::iota(groups.begin(), groups.end(), 0);
  return groups;
}

TEST_CASE("any plane leaves the mesh closed and area and volume as they were") {
  Rng rng(5);
  const Part part = plate();
  for (int round = 0; round < 40; ++round) {
    CutPlane plane;
    for (double& c : plane.normal) c = rng.uniform(-1, 1);
    plane.normal.normalize();
    plane.offset = rng.uniform(-1, 1);
    std::vector<int> chosen;
    for (const int g : all_groups(part)) {
      if (rng.coin()) chosen.push_back(g);
    }
    const EditedSegmentation cut = bisect(part, chosen, plane);
    CHECK(solids::is_closed(cut.mesh));
    CHECK(std::abs(cut.mesh.total_area - part.mesh.total_area) < 1e-12 * part.mesh.total_area);
    CHECK(std::abs(cut.mesh.volume - part.mesh.volume) < 1e-12 * part.mesh.volume);
    std::vector<double> area(part.segmentation.groups.size(), 0.0);
    for (std::size_t g = 0; g < cut.segmentation.groups.size(); ++g) {
      area[cut.source_group[g]] += cut.segmentation.groups[g].area;
    }
    for (std::size_t g = 0; g < area.size(); ++g) {
      CHECK(area[g] == doctest::Approx(part.segmentation.groups[g].area).epsilon(1e-12));
    }
  }
}

TEST_CASE("chosen groups lie on one side of the plane, others stay whole") {
  const Part part = plate();
  const CutPlane plane{Vec3(1, 0.3, 0.2).normalized(), 0.1};
  const std::vector<int> chosen{5, 6};  // the top and the hole
  const EditedSegmentation cut = bisect(part, chosen, plane);
  REQUIRE(cut.segmentation.groups.size() == 9);
  CHECK(cut.source_group == std::vector<int>{0, 1, 2, 3, 4, 5, 6, 5, 6});
  for (const int g : {5, 6, 7, 8}) {
    for (const int t : cut.segmentation.groups[g].triangles) {
      for (int k = 0; k < 3; ++k) {
        const double height = plane.normal.dot(cut.mesh.corner(t, k)) - plane.offset;
        CHECK((g <= 6 ? height : -height) > -1e-5);
      }
    }
  }
  CHECK(cut.segmentation.groups[4].area ==
        doctest::Approx(part.segmentation.groups[4].area).epsilon(1e-12));
}

TEST_CASE("groups and triangles refer to each other") {
  const Part part = plate();
  const EditedSegmentation cut = bisect(part, all_groups(part), {Vec3(0, 1, 1).normalized(), 0.2});
  std::size_t listed = 0;
  for (int g = 0; g < static_cast<int>(cut.segmentation.groups.size()); ++g) {
    const FaceGroup& group = cut.segmentation.groups[g];
    CHECK_FALSE(group.triangles.empty());
    listed += group.triangles.size();
    for (const int t : group.triangles) {
      CHECK(cut.segmentation.group_of_triangle[t] == g);
      const Vec3& before = part.mesh.normals[cut.source_triangle[t]];
      CHECK((cut.mesh.normals[t] - before).norm() < 1e-9);
    }
  }
  CHECK(listed == cut.mesh.triangles.size());
}

TEST_CASE("a plane through vertices adds none beside them") {
  const Part part = plate();
  // Through the hole's axis and its vertices, off by less than the snapping distance.
  const Vec3 normal(std::sin(0.75 * kPi), -std::cos(0.75 * kPi), 0);
  const EditedSegmentation cut = bisect(part, {6}, {normal, 1e-7});
  CHECK(cut.mesh.vertices.size() == part.mesh.vertices.size());
  CHECK(cut.segmentation.groups.size() == 8);
  CHECK(cut.segmentation.groups[6].area == doctest::Approx(cut.segmentation.groups[7].area));
}

TEST_CASE("a plane that misses the chosen groups changes nothing") {
  const Part part = plate();
  const EditedSegmentation cut = bisect(part, {0}, {Vec3::UnitX(), 0});
  CHECK(cut.mesh.triangles == part.mesh.triangles);
  CHECK(cut.segmentation.group_of_triangle == part.segmentation.group_of_triangle);
}

TEST_CASE("facets are cut with their groups") {
  Part part;
  part.mesh = solids::box({0, 0, 0}, {1, 1, 1});
  part.segmentation = segment_by_surfaces(part.mesh, box_sides({0, 0, 0}, {1, 1, 1}));
  for (const FaceGroup& group : part.segmentation.groups) {
    part.segmentation.facets.push_back(
        {group.triangles, group.surface.axis, Vec3::Zero(), group.area});
  }
  part.segmentation.facet_of_triangle = part.segmentation.group_of_triangle;
  const EditedSegmentation cut = bisect(part, {1}, {Vec3::UnitZ(), 0.25});
  REQUIRE(cut.segmentation.facets.size() == 7);
  CHECK(cut.segmentation.facets[1].area == doctest::Approx(0.75));
  CHECK(cut.segmentation.facets[6].area == doctest::Approx(0.25));
  CHECK(cut.segmentation.facets[6].centroid.z() == doctest::Approx(0.125));
}

TEST_CASE("a wrong group and a wrong normal are reported") {
  const Part part = plate();
  const int none[] = {7};
  const auto no_group = bisect_groups(part.mesh, part.segmentation, none, {}, {}, {});
  REQUIRE_FALSE(no_group.has_value());
  CHECK(no_group.error().message == "there is no face group 7; choose one of 0 to 6");
  const CutPlane zero{Vec3::Zero(), 0};
  const auto no_normal = bisect_groups(part.mesh, part.segmentation, {}, zero, {}, {});
  REQUIRE_FALSE(no_normal.has_value());
  CHECK(no_normal.error().code == ErrorCode::InvalidArgument);
}

}  // namespace
}  // namespace hewn
