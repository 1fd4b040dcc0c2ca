#include "core/segment/measure_group.h"

#include <algorithm>

namespace hewn {

std::vector<int> vertices_of(const Mesh& mesh, const std::vector<int>& triangles) {
  std::vector<int> vertices;
  vertices.reserve(triangles.size() * 3);
  for (const int t : triangles) {
    vertices.insert(vertices.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

void measure_group(const Mesh& mesh, FaceGroup& group) {
  group.area = 0;
  group.max_deviation = 0;
  double agreement = 0;
  for (const int t : group.triangles) {
    const Vec3 center = mesh.centroid(t);
    group.area += mesh.areas[t];
    agreement += mesh.areas[t] * group.surface.gradient(center).dot(mesh.normals[t]);
    group.max_deviation =
        std::max(group.max_deviation, std::abs(group.surface.signed_distance(center)));
  }
  group.side = agreement < 0 ? -1 : 1;
  double sum = 0;
  const std::vector<int> vertices = vertices_of(mesh, group.triangles);
  for (const int v : vertices) {
    const double distance = group.surface.signed_distance(mesh.vertices[v]);
    sum += distance * distance;
    group.max_deviation = std::max(group.max_deviation, std::abs(distance));
  }
  group.rms_deviation =
      vertices.empty() ? 0 : std::sqrt(sum / static_cast<double>(vertices.size()));
}

}  // namespace hewn
