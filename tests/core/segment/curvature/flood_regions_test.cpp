#include <set>

#include <doctest/doctest.h>

#include "tests/core/segment/curvature/stages.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

std::size_t region_count(const Mesh& mesh) {
  const CurvatureStages s = run_stages(mesh);
  return std::set<int>(s.labels.begin(), s.labels.end()).size();
}

TEST_CASE("simple solids fall apart into their faces") {
  CHECK(region_count(solids::box({0, 0, 0}, {1, 2, 3}, 4)) == 6);
  CHECK(region_count(solids::cylinder(1, 2, 48, 2)) == 3);
  CHECK(region_count(solids::plate_with_hole({4, 3, 1}, 1, 48)) == 7);
}

TEST_CASE("a label is the lowest index of a connected region of one class") {
  const Mesh mesh = solids::capsule(1, 4, 48, 12);
  const CurvatureStages s = run_stages(mesh);
  for (int t = 0; t < static_cast<int>(s.labels.size()); ++t) {
    CHECK(s.labels[t] <= t);
    CHECK(s.labels[s.labels[t]] == s.labels[t]);
    CHECK(s.classes[s.labels[t]] == s.classes[t]);
    for (int k = 0; k < 3; ++k) {
      const int other = s.topology.neighbors[t][k];
      const bool is_joined = !s.boundaries.is_marked[t][k] && s.classes[other] == s.classes[t];
      if (is_joined) CHECK(s.labels[other] == s.labels[t]);
    }
  }
}

TEST_CASE("a region of many triangles in a row gets one label") {
  const Mesh mesh = solids::cylinder(1, 100, 12, 2000);
  CurvatureOptions options;
  options.ridge_angle_deg = 45;
  const CurvatureStages s = run_stages(mesh, options);
  CHECK(std::set<int>(s.labels.begin(), s.labels.end()).size() == 3);
}

TEST_CASE("triangles without area belong to no region") {
  const Mesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const CurvatureStages s = run_stages(mesh);
  CHECK(s.labels[0] == -1);
  CHECK(s.labels[1] == 1);
}

}  // namespace
}  // namespace hewn
