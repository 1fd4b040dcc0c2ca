#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "core/mesh/load.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

double noise_of(const Mesh& mesh) {
  const auto loaded = repair_mesh(mesh.vertices, mesh.triangles, {}, {});
  REQUIRE(loaded);
  return loaded->report.noise / loaded->mesh.diagonal();
}

Mesh part() {
  return solids::transformed(solids::plate_with_hole({4, 4, 1}, 1, 64, 4),
                             solids::oblique_transform());
}

TEST_CASE("an exact mesh has no noise") { CHECK(noise_of(part()) < 1e-12); }

TEST_CASE("six decimals show as half of the sixth decimal") {
  Mesh mesh = part();
  for (Vec3& v : mesh.vertices) v = (v * 1e6).array().round() / 1e6;
  const double noise = noise_of(mesh) * mesh.diagonal();
  CHECK(noise >= 4.9e-7);
  CHECK(noise < 1.5e-6);
}

TEST_CASE("single precision shows, and far from the origin more") {
  Mesh mesh = part();
  for (Vec3& v : mesh.vertices) v = v.cast<float>().cast<double>();
  CHECK(noise_of(mesh) < 1e-6);
  Mesh far = part();
  for (Vec3& v : far.vertices) v = (v + Vec3(600, 0, 0)).cast<float>().cast<double>();
  CHECK(noise_of(far) > 1e-6);
}

TEST_CASE("jitter of the vertices is measured within a factor of two") {
  for (const double sigma : {3e-6, 1e-5, 3e-5}) {
    Mesh mesh = part();
    Rng rng(9);
    const double half_width = sigma * mesh.diagonal() * std::sqrt(3.0);
    for (Vec3& v : mesh.vertices) {
      for (double& c : v) c += rng.uniform(-half_width, half_width);
    }
    const double noise = noise_of(mesh);
    CHECK(noise > sigma / 2);
    CHECK(noise < sigma * 2);
  }
}

TEST_CASE("round dimensions of a designer are not taken for rounding") {
  CHECK(noise_of(solids::box({0, 0, 0}, {10, 20, 30})) < 1e-12);
}

}  // namespace
}  // namespace hewn
