#include "core/segment/triangle_topology.h"

#include <algorithm>

namespace hewn {
namespace {

int side_of(const Triangle& triangle, int a, int b) {
  for (int k = 0; k < 3; ++k) {
    const int p = triangle[k];
    const int q = triangle[(k + 1) % 3];
    if ((p == a && q == b) || (p == b && q == a)) return k;
  }
  return 0;
}

}  // namespace

TriangleTopology build_topology(const Mesh& mesh) {
  TriangleTopology topology;
  topology.neighbors.assign(mesh.triangles.size(), {-1, -1, -1});
  for (const Edge& edge : build_edges(mesh)) {
    if (edge.triangles.size() != 2) continue;
    const int s = edge.triangles[0];
    const int t = edge.triangles[1];
    topology.neighbors[s][side_of(mesh.triangles[s], edge.a, edge.b)] = t;
    topology.neighbors[t][side_of(mesh.triangles[t], edge.a, edge.b)] = s;
  }
  topology.first_corner.assign(mesh.vertices.size() + 1, 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (const int v : triangle) ++topology.first_corner[v + 1];
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    topology.first_corner[v + 1] += topology.first_corner[v];
  }
  topology.corners.resize(mesh.triangles.size() * 3);
  std::vector<int> next(topology.first_corner.begin(), topology.first_corner.end() - 1);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) topology.corners[next[mesh.triangles[t][k]]++] = 3 * t + k;
  }
  return topology;
}

}  // namespace hewn
