#include "core/segment/curvature/boundaries.h"

#include <algorithm>

namespace hewn {

Boundaries find_boundaries(const Mesh& mesh, const TriangleTopology& topology,
                           const std::vector<VertexClass>& classes,
                           const CurvatureOptions& options) {
  Boundaries boundaries;
  boundaries.is_marked.assign(mesh.triangles.size(), {false, false, false});
  // Twice the number of marked edges: an edge with two triangles is seen from both.
  std::vector<int> marks(mesh.vertices.size(), 0);
  const double ridge_angle = options.ridge_angle_deg * kPi / 180;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k];
      const int b = mesh.triangles[t][(k + 1) % 3];
      const int other = topology.neighbors[t][k];
      const bool is_rim = other < 0;
      const bool is_sharp = !is_rim && classes[a] != VertexClass::Face &&
                            classes[b] != VertexClass::Face &&
                            angle_between(mesh.normals[t], mesh.normals[other]) > ridge_angle;
      if (!is_rim && !is_sharp) continue;
      boundaries.is_marked[t][k] = true;
      for (const int v : {a, b}) marks[v] += is_rim ? 2 : 1;
    }
  }
  boundaries.group_count.reserve(marks.size());
  for (const int m : marks) boundaries.group_count.push_back(std::max(1, m / 2));
  return boundaries;
}

}  // namespace hewn
