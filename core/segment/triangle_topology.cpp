#include "core/segment/triangle_topology.h"

#include "core/segment/facets.h"

namespace hewn {
TriangleTopology build_topology(const Mesh& mesh) {
  TriangleTopology topology;
  topology.neighbors = triangle_neighbors(mesh);
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
