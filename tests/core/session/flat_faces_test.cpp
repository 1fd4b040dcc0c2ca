#include "core/session/flat_faces.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "tests/support/solids.h"

namespace hewn {
namespace {

TEST_CASE("a flat face takes the label of most of its area") {
  const Mesh mesh = solids::box({0, 0, 0}, {3, 2, 1}, 2);
  std::vector<int> labels(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < labels.size(); ++t) {
    if (mesh.normals[t].z() > 0.5 && mesh.centroid(static_cast<int>(t)).x() < 1) labels[t] = 1;
  }
  unify_flat_faces(mesh, labels);
  CHECK(std::count(labels.begin(), labels.end(), 1) == 0);
}

}  // namespace
}  // namespace hewn
