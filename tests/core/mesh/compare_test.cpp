#include "core/mesh/compare.h"

#include <doctest/doctest.h>

#include "tests/support/solids.h"

namespace hewn {
namespace {

MeshQuery query_of(Mesh mesh) { return MeshQuery(std::make_shared<const Mesh>(std::move(mesh))); }

TEST_CASE("a mesh does not differ from itself") {
  const MeshQuery a = query_of(solids::torus(2, 0.5, 48, 24));
  const auto d = compare_meshes(a, a, {}, {});
  REQUIRE(d);
  CHECK(d->hausdorff < 1e-9);
  CHECK(d->iou == 1);
}

TEST_CASE("a shifted box is as far as its shift, with the known common volume") {
  const MeshQuery a = query_of(solids::box({0, 0, 0}, {2, 2, 1}));
  const MeshQuery b = query_of(solids::box({0.5, 0, 0}, {2.5, 2, 1}));
  const auto d = compare_meshes(a, b, {}, {});
  REQUIRE(d);
  CHECK(d->hausdorff == doctest::Approx(0.5 / 3));
  CHECK(d->iou == doctest::Approx(1.5 / 2.5).epsilon(0.01));
  CHECK(d->mean > 0.01);
  CHECK(d->mean < d->p999);
}

TEST_CASE("what sticks out of one mesh shows in one direction only") {
  const Mesh box = solids::box({0, 0, 0}, {2, 2, 1});
  const MeshQuery a = query_of(box);
  const MeshQuery b = query_of(solids::together(box, solids::box({0.9, 0.9, 1.5}, {1.1, 1.1, 3})));
  const auto d = compare_meshes(a, b, {}, {});
  REQUIRE(d);
  CHECK(d->a_to_b.max < 1e-9);
  CHECK(d->b_to_a.max == doctest::Approx(2.0 / 3));
}

TEST_CASE("the comparison is the same on any number of threads") {
  const MeshQuery a = query_of(solids::sphere(1, 32, 16));
  const MeshQuery b = query_of(solids::sphere(1.01, 48, 24));
  RunContext one;
  one.threads = 1;
  RunContext four;
  four.threads = 4;
  const auto d1 = compare_meshes(a, b, {}, one);
  const auto d4 = compare_meshes(a, b, {}, four);
  REQUIRE(d1);
  REQUIRE(d4);
  CHECK(d1->mean == d4->mean);
  CHECK(d1->hausdorff == d4->hausdorff);
  CHECK(d1->iou == d4->iou);
}

TEST_CASE("a cancelled comparison stops") {
  const MeshQuery a = query_of(solids::sphere(1, 32, 16));
  RunContext run;
  run.cancel->cancel();
  const auto d = compare_meshes(a, a, {}, run);
  REQUIRE(!d);
  CHECK(d.error().code == ErrorCode::Cancelled);
}

}  // namespace
}  // namespace hewn
