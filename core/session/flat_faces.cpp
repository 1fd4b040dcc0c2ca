#include "core/session/flat_faces.h"

#include <algorithm>
#include <map>

#include "core/segment/triangle_topology.h"

namespace hewn {
namespace {

constexpr double kFlat = 1 - 1e-7;

}  // namespace

void unify_flat_faces(const Mesh& mesh, std::vector<int>& labels) {
  const TriangleTopology topology = build_topology(mesh);
  std::vector<char> seen(labels.size(), 0);
  std::vector<int> triangles;
  for (std::size_t start = 0; start < labels.size(); ++start) {
    if (seen[start]) continue;
    triangles.assign(1, static_cast<int>(start));
    seen[start] = 1;
    std::map<int, double> areas;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const int t = triangles[i];
      areas[labels[t]] += mesh.areas[t];
      for (const int next : topology.neighbors[t]) {
        if (next < 0 || seen[next] || mesh.normals[next].dot(mesh.normals[t]) < kFlat) continue;
        seen[next] = 1;
        triangles.push_back(next);
      }
    }
    const auto most = std::max_element(areas.begin(), areas.end(),
                                       [](auto& a, auto& b) { return a.second < b.second; });
    for (const int t : triangles) labels[t] = most->first;
  }
}

}  // namespace hewn
