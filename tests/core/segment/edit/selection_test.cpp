#include "core/segment/edit/selection.h"

#include <doctest/doctest.h>

#include "tests/core/segment/edit/known_groups.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

using List = std::vector<int>;

TEST_CASE("a ring around a triangle is added and taken away again") {
  const TriangleTopology topology = build_topology(solids::torus(3, 1, 24, 16));
  const List one{100};
  const List grown = grow_triangles(topology, one, 1);
  CHECK(grown.size() == 4);
  CHECK(shrink_triangles(topology, grown, 1) == one);
  CHECK(grow_triangles(topology, one, 3).size() > grown.size());
  CHECK(shrink_triangles(topology, one, 1).empty());
}

TEST_CASE("growing ends at the whole mesh, and the whole mesh does not shrink") {
  const TriangleTopology topology = build_topology(solids::box({0, 0, 0}, {1, 1, 1}));
  const List all = grow_triangles(topology, List{0}, 12);
  CHECK(all.size() == 12);
  CHECK(shrink_triangles(topology, all, 5) == all);
}

TEST_CASE("groups grow to their neighbours across edges") {
  const Vec3 hi(1, 2, 3);
  const Mesh mesh = solids::box({0, 0, 0}, hi, 2);
  const Segmentation segmentation = segment_by_surfaces(mesh, box_sides({0, 0, 0}, hi));
  const auto neighbors = group_neighbors(segmentation, build_topology(mesh));
  CHECK(neighbors[0] == List{2, 3, 4, 5});
  CHECK(grow_groups(neighbors, List{0}) == List{0, 2, 3, 4, 5});
  CHECK(grow_groups(neighbors, List{0}, 2) == List{0, 1, 2, 3, 4, 5});
  CHECK(shrink_groups(neighbors, List{0, 2, 3, 4, 5}) == List{0});
}

Segmentation of_surfaces(const std::vector<Surface>& surfaces) {
  Segmentation segmentation;
  for (const Surface& surface : surfaces) {
    segmentation.groups.emplace_back();
    segmentation.groups.back().surface = surface;
  }
  return segmentation;
}

TEST_CASE("similar groups share kind, direction, axis and radius as asked") {
  const Vec3 z = Vec3::UnitZ();
  Surface ball;
  ball.kind = SurfaceKind::Sphere;
  ball.point = Vec3(0, 0, 7);
  ball.radius = 1;
  Segmentation s = of_surfaces({
      cylinder_surface({0, 0, 0}, z, 1),              // 0: the example
      cylinder_surface({0, 0, 5}, -z, 1),             // 1: the same, turned round
      cylinder_surface({3, 0, 0}, z, 1),              // 2: beside it
      cylinder_surface({0, 0, 0}, z, 2),              // 3: around it
      cylinder_surface({0, 0, 0}, Vec3::UnitX(), 1),  // 4: across it
      plane(z, 4),                                    // 5: its cap
      ball,                                           // 6: on its axis
      cylinder_surface({0, 0, 0}, z, 1),              // 7: a hole
  });
  s.groups[7].side = -1;
  const auto similar = [&](bool same_kind, bool parallel, bool coaxial, bool same_radius) {
    Similarity similarity;
    similarity.same_kind = same_kind;
    similarity.parallel = parallel;
    similarity.coaxial = coaxial;
    similarity.same_radius = same_radius;
    similarity.length = 1e-6;
    return select_similar(s, 0, similarity);
  };
  CHECK(similar(true, false, false, false) == List{0, 1, 2, 3, 4});
  CHECK(similar(true, true, false, false) == List{0, 1, 2, 3});
  CHECK(similar(true, false, true, false) == List{0, 1, 3});
  CHECK(similar(true, false, false, true) == List{0, 1, 2, 4});
  CHECK(similar(true, true, true, true) == List{0, 1});
  CHECK(similar(false, false, true, false) == List{0, 1, 3, 5, 6, 7});
}

TEST_CASE("cones are alike by their angle, tori by both radii") {
  Surface cone;
  cone.kind = SurfaceKind::Cone;
  cone.half_angle_rad = 0.5;
  Surface blunt = cone;
  blunt.half_angle_rad = 0.6;
  Surface ring;
  ring.kind = SurfaceKind::Torus;
  ring.major_radius = 3;
  ring.radius = 1;
  Surface wide = ring;
  wide.major_radius = 4;
  const Segmentation s = of_surfaces({cone, blunt, cone, ring, wide, ring});
  Similarity similarity;
  similarity.same_radius = true;
  similarity.length = 1e-6;
  CHECK(select_similar(s, 0, similarity) == List{0, 2});
  CHECK(select_similar(s, 3, similarity) == List{3, 5});
}

}  // namespace
}  // namespace hewn
