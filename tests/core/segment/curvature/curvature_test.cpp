#include "core/segment/curvature/curvature.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "core/segment/segment.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

constexpr RegionGrowth kBothGrowths[] = {RegionGrowth::Flood, RegionGrowth::Fit};

Segmentation segment(const Mesh& mesh, RegionGrowth growth, int threads = 1,
                     std::uint64_t seed = 1) {
  CurvatureOptions options;
  options.growth = static_cast<int>(growth);
  RunContext run;
  run.threads = threads;
  run.seed = seed;
  auto result = segment_by_curvature(mesh, options, run);
  REQUIRE(result.has_value());
  return std::move(*result);
}

int count(const Segmentation& segmentation, SurfaceKind kind, int side) {
  return static_cast<int>(
      std::count_if(segmentation.groups.begin(), segmentation.groups.end(),
                    [&](const FaceGroup& g) { return g.surface.kind == kind && g.side == side; }));
}

void check_is_partition(const Mesh& mesh, const Segmentation& segmentation) {
  std::size_t listed = 0;
  double area = 0;
  for (int g = 0; g < static_cast<int>(segmentation.groups.size()); ++g) {
    const FaceGroup& group = segmentation.groups[g];
    CHECK(std::is_sorted(group.triangles.begin(), group.triangles.end()));
    for (const int t : group.triangles) CHECK(segmentation.group_of_triangle[t] == g);
    listed += group.triangles.size();
    area += group.area;
  }
  CHECK(listed == mesh.triangles.size());
  CHECK(area == doctest::Approx(mesh.total_area));
}

TEST_CASE("a box has six planes") {
  for (const RegionGrowth growth : kBothGrowths) {
    const Mesh mesh =
        solids::transformed(solids::box({0, 0, 0}, {1, 2, 3}, 5), solids::oblique_transform());
    const Segmentation s = segment(mesh, growth);
    check_is_partition(mesh, s);
    REQUIRE(s.groups.size() == 6);
    for (const FaceGroup& group : s.groups) {
      CHECK(group.surface.kind == SurfaceKind::Plane);
      CHECK(group.max_deviation < 1e-12);
    }
  }
}

TEST_CASE("cylinders, cones and holes get their radii and angles") {
  for (const RegionGrowth growth : kBothGrowths) {
    const Segmentation rod = segment(solids::cylinder(1.5, 4, 40, 2), growth);
    REQUIRE(rod.groups.size() == 3);
    CHECK(count(rod, SurfaceKind::Cylinder, 1) == 1);

    const Segmentation plug = segment(solids::cone(2, 1, 3, 40, 2), growth);
    REQUIRE(plug.groups.size() == 3);
    REQUIRE(count(plug, SurfaceKind::Cone, 1) == 1);
    for (const FaceGroup& group : plug.groups) {
      if (group.surface.kind != SurfaceKind::Cone) continue;
      CHECK(group.surface.half_angle_rad == doctest::Approx(std::atan2(1, 3)).epsilon(1e-6));
      CHECK((group.surface.point - Vec3(0, 0, 6)).norm() < 1e-6);
    }

    const Segmentation plate = segment(solids::plate_with_hole({6, 5, 1}, 1.25, 48, 1), growth);
    REQUIRE(plate.groups.size() == 7);
    REQUIRE(count(plate, SurfaceKind::Cylinder, -1) == 1);
    for (const FaceGroup& group : plate.groups) {
      if (group.surface.kind == SurfaceKind::Cylinder) {
        CHECK(group.surface.radius == doctest::Approx(1.25).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("parts that join smoothly are told apart by fitting") {
  const Mesh mesh = solids::transformed(solids::capsule(1, 4, 48, 12), solids::oblique_transform());
  const Segmentation s = segment(mesh, RegionGrowth::Fit);
  check_is_partition(mesh, s);
  CHECK(s.groups.size() == 3);
  CHECK(count(s, SurfaceKind::Sphere, 1) == 2);
  CHECK(count(s, SurfaceKind::Cylinder, 1) == 1);
  for (const FaceGroup& group : s.groups) {
    CHECK(group.surface.radius == doctest::Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("a fillet is a cylinder between two planes") {
  const Mesh mesh = solids::block_with_fillet({4, 3, 2}, 0.8, 9);
  const Segmentation s = segment(mesh, RegionGrowth::Fit);
  check_is_partition(mesh, s);
  CHECK(count(s, SurfaceKind::Plane, 1) == 6);
  CHECK(count(s, SurfaceKind::Cylinder, 1) == 1);
  CHECK(s.groups.size() == 7);
}

TEST_CASE("a cone that goes over into another is not taken for one") {
  // The flanks meet at 14 degrees, well below the ridge angle.
  const Mesh mesh = solids::revolve({{0, 0}, {2, 0}, {2, 2}, {1.5, 4}, {0, 4}}, 64);
  const Segmentation s = segment(mesh, RegionGrowth::Fit);
  check_is_partition(mesh, s);
  CHECK(s.groups.size() == 4);
  CHECK(count(s, SurfaceKind::Cylinder, 1) == 1);
  CHECK(count(s, SurfaceKind::Cone, 1) == 1);
}

TEST_CASE("thread count does not change a bit, and the same seed repeats") {
  const Mesh mesh = solids::transformed(solids::capsule(1, 4, 48, 12), solids::oblique_transform());
  for (const RegionGrowth growth : kBothGrowths) {
    const Segmentation one = segment(mesh, growth, 1, 7);
    const Segmentation four = segment(mesh, growth, 4, 7);
    CHECK(one.group_of_triangle == four.group_of_triangle);
    REQUIRE(one.groups.size() == four.groups.size());
    for (std::size_t g = 0; g < one.groups.size(); ++g) {
      CHECK(one.groups[g].surface.point == four.groups[g].surface.point);
      CHECK(one.groups[g].surface.axis == four.groups[g].surface.axis);
      CHECK(one.groups[g].surface.radius == four.groups[g].surface.radius);
      CHECK(one.groups[g].rms_deviation == four.groups[g].rms_deviation);
    }
  }
}

TEST_CASE("scale does not change the groups") {
  const Mesh mesh = solids::plate_with_hole({6, 5, 1}, 1.25, 48, 2);
  const std::vector<int> groups = segment(mesh, RegionGrowth::Fit).group_of_triangle;
  for (const double scale : {1e-3, 1e3}) {
    const Mesh scaled = solids::transformed(mesh, Affine3(Eigen::Scaling(scale)));
    CHECK(segment(scaled, RegionGrowth::Fit).group_of_triangle == groups);
  }
}

TEST_CASE("the method is chosen by its option and fills in facets") {
  const Mesh mesh = solids::plate_with_hole({6, 5, 1}, 1.25, 48, 1);
  SegmentOptions options;
  options.method = static_cast<int>(SegmentMethod::Curvature);
  const auto s = hewn::segment(mesh, options, {});
  REQUIRE(s.has_value());
  CHECK(s->groups.size() == 7);
  CHECK(s->facets.size() == 6 + 48);
  CHECK(s->facet_of_triangle.size() == mesh.triangles.size());
}

TEST_CASE("an empty mesh is reported, a cancelled run too") {
  const auto empty = segment_by_curvature(make_mesh({}, {}), CurvatureOptions{}, {});
  REQUIRE_FALSE(empty.has_value());
  CHECK(empty.error().code == ErrorCode::BadMesh);
  RunContext run;
  run.cancel->cancel();
  const auto cancelled =
      segment_by_curvature(solids::box({0, 0, 0}, {1, 1, 1}), CurvatureOptions{}, run);
  REQUIRE_FALSE(cancelled.has_value());
  CHECK(cancelled.error().code == ErrorCode::Cancelled);
}

}  // namespace
}  // namespace hewn
