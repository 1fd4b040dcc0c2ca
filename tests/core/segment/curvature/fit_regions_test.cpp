#include "core/segment/curvature/fit_regions.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "tests/core/segment/curvature/stages.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

std::vector<FittedRegion> grow(const Mesh& mesh, std::uint64_t seed,
                               const std::vector<bool>& is_candidate) {
  const CurvatureStages s = run_stages(mesh);
  RunContext run;
  run.seed = seed;
  return *grow_fitted_regions(s, is_candidate, {}, run);
}

std::vector<bool> all_of(const Mesh& mesh) {
  std::vector<bool> all(mesh.triangles.size(), true);
  return all;
}

TEST_CASE("a region covers its whole face from whichever seed") {
  const Mesh mesh = solids::cylinder(1, 3, 40, 6);
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const auto regions = grow(mesh, seed, all_of(mesh));
    REQUIRE(regions.size() == 3);
    for (const FittedRegion& region : regions) {
      CHECK(std::is_sorted(region.triangles.begin(), region.triangles.end()));
      const bool is_flank = region.surface.kind == SurfaceKind::Cylinder;
      CHECK(region.triangles.size() == (is_flank ? 40 * 2 * 6 : 40));
    }
  }
}

TEST_CASE("regions hold candidates only") {
  const Mesh mesh = solids::box({0, 0, 0}, {1, 1, 1}, 4);
  std::vector<bool> is_candidate = all_of(mesh);
  for (std::size_t t = 0; t < is_candidate.size(); t += 2) is_candidate[t] = false;
  for (const FittedRegion& region : grow(mesh, 1, is_candidate)) {
    for (const int t : region.triangles) CHECK(is_candidate[t]);
  }
}

TEST_CASE("every triangle on a region lies on its surface") {
  const Mesh mesh = solids::capsule(1, 4, 48, 12);
  const auto regions = grow(mesh, 1, all_of(mesh));
  CHECK(regions.size() >= 3);
  for (const FittedRegion& region : regions) {
    for (const int t : region.triangles) {
      CHECK(misfit(mesh, t, region.surface, fit_limits(mesh, {})) < 1.5);
    }
  }
}

}  // namespace
}  // namespace hewn
