#include "core/mesh/sampling.h"

#include <doctest/doctest.h>

#include "tests/support/solids.h"

namespace hewn {
namespace {

TEST_CASE("triangles are drawn by area and points lie in them") {
  const Mesh box = solids::box({0, 0, 0}, {1, 1, 4});
  const SurfaceSampler sampler(box);
  Rng rng(1);
  int caps = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const SurfacePoint p = sampler.draw(rng);
    if (std::abs(p.normal.z()) > 0.5) ++caps;
    CHECK(std::abs(p.normal.dot(p.position - box.corner(p.triangle, 0))) < 1e-12);
    CHECK(box.bounds.contains(p.position, 1e-12));
  }
  CHECK(caps == doctest::Approx(n * 2.0 / 18).epsilon(0.1));
}

TEST_CASE("points of a triangle are spread evenly") {
  const Mesh mesh = make_mesh({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}});
  Rng rng(2);
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < 20000; ++i) mean += sample_triangle(mesh, 0, rng) / 20000;
  CHECK((mean - mesh.centroid(0)).norm() < 0.02);
}

TEST_CASE("a sampler of chosen triangles draws only those") {
  const Mesh box = solids::box({0, 0, 0}, {1, 1, 1});
  const SurfaceSampler sampler(box, {3, 5});
  Rng rng(3);
  bool saw[2] = {false, false};
  for (int i = 0; i < 100; ++i) {
    const int t = sampler.draw(rng).triangle;
    CHECK((t == 3 || t == 5));
    saw[t == 5] = true;
  }
  CHECK(saw[0]);
  CHECK(saw[1]);
  CHECK(SurfaceSampler(box, {}).is_empty());
}

TEST_CASE("equal seeds draw equal points") {
  const Mesh sphere = solids::sphere(1, 16, 8);
  const SurfaceSampler sampler(sphere);
  Rng a(7);
  Rng b(7);
  for (int i = 0; i < 50; ++i) CHECK(sampler.draw(a).position == sampler.draw(b).position);
}

}  // namespace
}  // namespace hewn
