#include "bench/variants/variants.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "bench/variants/remesh.h"
#include "core/fit/surface_set.h"
#include "core/mesh/compare.h"
#include "core/segment/segment.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

Mesh part() { return solids::plate_with_hole({4, 3, 1}, 1, 32); }

MeshQuery query_of(Mesh mesh) { return MeshQuery(std::make_shared<const Mesh>(std::move(mesh))); }

TEST_CASE("a remeshed part is the same solid in small triangles of similar sides") {
  const Mesh input = part();
  const auto remeshed = remesh_isotropic(input, {}, {});
  REQUIRE(remeshed);
  CHECK(solids::is_closed(*remeshed));
  CHECK(remeshed->triangles.size() > 3 * input.triangles.size());
  const auto difference = compare_meshes(query_of(input), query_of(*remeshed), {}, {});
  REQUIRE(difference);
  CHECK(difference->hausdorff < 2e-3);
  CHECK(difference->iou > 0.998);
  // Quality: twice the in-circle's over the circumcircle's radius; 1 for equal sides.
  std::vector<double> quality;
  for (int t = 0; t < static_cast<int>(remeshed->triangles.size()); ++t) {
    const double a = (remeshed->corner(t, 1) - remeshed->corner(t, 0)).norm();
    const double b = (remeshed->corner(t, 2) - remeshed->corner(t, 1)).norm();
    const double c = (remeshed->corner(t, 0) - remeshed->corner(t, 2)).norm();
    const double area = remeshed->areas[t];
    quality.push_back(16 * area * area / ((a + b + c) * a * b * c));
  }
  std::sort(quality.begin(), quality.end());
  CHECK(quality[quality.size() / 10] > 0.6);
  CHECK(quality[quality.size() / 2] > 0.85);
}

TEST_CASE("sharp edges and corners survive remeshing") {
  const Mesh box = solids::box({0, 0, 0}, {3, 2, 1});
  const auto remeshed = remesh_isotropic(box, {}, {});
  REQUIRE(remeshed);
  CHECK(remeshed->volume == doctest::Approx(6).epsilon(1e-9));
  CHECK(remeshed->total_area == doctest::Approx(22).epsilon(1e-9));
}

TEST_CASE("a remeshed fillet and the planes that it touches come out as exact as before") {
  const Mesh block = solids::block_with_fillet(Vec3(3, 2, 1), 0.5, 15);
  RemeshOptions options;
  options.min_growth = 120;  // triangles about as wide as the fillet's facets: none of them is flat
  const auto mesh = remesh_isotropic(block, options, {});
  REQUIRE(mesh);
  const auto segmentation = segment(*mesh, {}, {});
  REQUIRE(segmentation);
  const auto set = regularise(*mesh, *segmentation, {}, {});
  REQUIRE(set);
  REQUIRE(set->halfspaces.size() == 7);
  for (const Halfspace& h : set->halfspaces) {
    if (h.surface.kind == SurfaceKind::Plane) {
      const double offset = std::abs(h.surface.offset);
      CHECK(offset == std::round(offset));
      continue;
    }
    REQUIRE(h.surface.kind == SurfaceKind::Cylinder);
    CHECK(h.surface.radius == doctest::Approx(0.5).epsilon(2e-3));
    CHECK((h.surface.point.head<2>() - Vec2(2.5, 1.5)).norm() < 1e-3);
  }
}

TEST_CASE("every variant keeps the solid up to its move and scale") {
  const Mesh input = part();
  const auto variants = make_variants(input, {});
  REQUIRE(variants);
  REQUIRE(variants->size() == 7);
  for (const Variant& v : *variants) {
    CAPTURE(v.name);
    const double scale = v.name == "scaled-up" ? 1e3 : v.name == "scaled-down" ? 1e-3 : 1;
    CHECK(v.mesh.volume / std::pow(scale, 3) == doctest::Approx(input.volume).epsilon(3e-3));
    if (v.name == "moved") {
      CHECK((v.mesh.bounds.center() - input.bounds.center()).norm() ==
            doctest::Approx(100 * input.diagonal()));
    }
    if (v.name == "jittered") {
      double farthest = 0;
      for (std::size_t i = 0; i < v.mesh.vertices.size(); ++i) {
        farthest = std::max(farthest, (v.mesh.vertices[i] - input.vertices[i]).norm());
      }
      CHECK(farthest <= 1e-5 * input.diagonal());
      CHECK(farthest > 0.8e-5 * input.diagonal());
    }
  }
}

TEST_CASE("equal seeds give equal variants, different ones different rotations") {
  RunContext run;
  const auto one = make_variants(part(), run);
  const auto two = make_variants(part(), run);
  run.seed = 2;
  const auto other = make_variants(part(), run);
  REQUIRE(one);
  REQUIRE(two);
  REQUIRE(other);
  for (std::size_t i = 0; i < one->size(); ++i) {
    CHECK((*one)[i].mesh.vertices == (*two)[i].mesh.vertices);
  }
  CHECK((*one)[0].mesh.vertices != (*other)[0].mesh.vertices);
}

}  // namespace
}  // namespace hewn
