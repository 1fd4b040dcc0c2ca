#include "core/segment/triangle_topology.h"

#include <doctest/doctest.h>

#include "tests/support/solids.h"

namespace hewn {
namespace {

TEST_CASE("neighbours across a side share its two vertices and point back") {
  const Mesh mesh = solids::torus(3, 1, 12, 8);
  const TriangleTopology topology = build_topology(mesh);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int other = topology.neighbors[t][k];
      REQUIRE(other >= 0);
      const int a = mesh.triangles[t][k];
      const int b = mesh.triangles[t][(k + 1) % 3];
      int back = -1;
      for (int j = 0; j < 3; ++j) {
        if (mesh.triangles[other][j] == b && mesh.triangles[other][(j + 1) % 3] == a) back = j;
      }
      REQUIRE(back >= 0);
      CHECK(topology.neighbors[other][back] == t);
    }
  }
}

TEST_CASE("every corner is listed once, at its own vertex") {
  const Mesh mesh = solids::box({0, 0, 0}, {1, 2, 3}, 2);
  const TriangleTopology topology = build_topology(mesh);
  std::size_t listed = 0;
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    for (const int corner : topology.corners_at(v)) {
      CHECK(mesh.triangles[corner / 3][corner % 3] == v);
      ++listed;
    }
  }
  CHECK(listed == mesh.triangles.size() * 3);
}

TEST_CASE("a hole's rim has no neighbour") {
  const Mesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
  const TriangleTopology topology = build_topology(mesh);
  CHECK(topology.neighbors[0][0] == -1);
  CHECK(topology.neighbors[0][1] == 1);
  CHECK(topology.neighbors[1][2] == 0);
}

}  // namespace
}  // namespace hewn
