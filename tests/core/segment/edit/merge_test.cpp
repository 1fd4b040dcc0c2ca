#include "core/segment/edit/merge.h"

#include <doctest/doctest.h>

#include "core/segment/edit/bisect.h"
#include "tests/core/segment/edit/known_groups.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

std::vector<Surface> plate_surfaces() {
  std::vector<Surface> surfaces = box_sides({-2, -1.5, -0.5}, {2, 1.5, 0.5});
  surfaces.push_back(cylinder_surface(Vec3::Zero(), Vec3::UnitZ(), 0.8));
  return surfaces;
}

TEST_CASE("halves of a cut hole become the hole again") {
  const Mesh mesh = solids::plate_with_hole({4, 3, 1}, 0.8, 48, 2);
  const Segmentation whole = segment_by_surfaces(mesh, plate_surfaces());
  const int hole[] = {6};
  const auto cut = bisect_groups(mesh, whole, hole, {Vec3::UnitX(), 0.1}, {}, {});
  REQUIRE(cut.has_value());
  REQUIRE(cut->segmentation.groups.size() == 8);
  const int halves[] = {7, 6};
  const auto merged = merge_groups(cut->mesh, cut->segmentation, halves, {}, {});
  REQUIRE(merged.has_value());
  REQUIRE(merged->segmentation.groups.size() == 7);
  const FaceGroup& group = merged->segmentation.groups[6];
  CHECK(group.is_fitted);
  CHECK(group.side == -1);
  CHECK(group.surface.kind == SurfaceKind::Cylinder);
  // Vertices on the cut lie on chords, inside the circle by up to the facets' depth.
  CHECK(group.surface.radius == doctest::Approx(0.8).epsilon(1e-6));
  CHECK(group.area == doctest::Approx(whole.groups[6].area).epsilon(1e-12));
}

TEST_CASE("later groups move up and triangles follow") {
  const Vec3 hi(1, 2, 3);
  const Mesh mesh = solids::box({0, 0, 0}, hi, 2);
  const Segmentation before = segment_by_surfaces(mesh, box_sides({0, 0, 0}, hi));
  const int chosen[] = {1, 3};
  const auto merged = merge_groups(mesh, before, chosen, {}, {});
  REQUIRE(merged.has_value());
  CHECK(merged->source_group == std::vector<int>{0, 1, 2, 4, 5});
  for (int g = 0; g < 5; ++g) {
    for (const int t : merged->segmentation.groups[g].triangles) {
      CHECK(merged->segmentation.group_of_triangle[t] == g);
    }
  }
  CHECK(merged->segmentation.groups[1].triangles.size() == 16);
}

TEST_CASE("two sides of a box are no one surface, and the group says so") {
  const Vec3 hi(1, 2, 3);
  const Mesh mesh = solids::box({0, 0, 0}, hi, 2);
  const Segmentation before = segment_by_surfaces(mesh, box_sides({0, 0, 0}, hi));
  const int chosen[] = {1, 3};
  const auto merged = merge_groups(mesh, before, chosen, {}, {});
  REQUIRE(merged.has_value());
  CHECK_FALSE(merged->segmentation.groups[1].is_fitted);
}

TEST_CASE("one group alone and unknown groups are refused") {
  const Mesh mesh = solids::box({0, 0, 0}, {1, 1, 1});
  const Segmentation before = segment_by_surfaces(mesh, box_sides({0, 0, 0}, {1, 1, 1}));
  const int twice[] = {2, 2};
  const auto alone = merge_groups(mesh, before, twice, {}, {});
  REQUIRE_FALSE(alone.has_value());
  CHECK(alone.error().code == ErrorCode::InvalidArgument);
  const int unknown[] = {0, 6};
  CHECK_FALSE(merge_groups(mesh, before, unknown, {}, {}).has_value());
}

}  // namespace
}  // namespace hewn
