#include "core/mesh/mesh.h"

#include <algorithm>
#include <utility>

namespace hewn {

Mesh make_mesh(std::vector<Vec3> vertices, std::vector<Triangle> triangles) {
  Mesh mesh;
  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(triangles);
  mesh.normals.reserve(mesh.triangles.size());
  mesh.areas.reserve(mesh.triangles.size());
  for (const Vec3& p : mesh.vertices) mesh.bounds.extend(p);
  const Vec3 center = mesh.bounds.center();
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = mesh.vertices[a] - center;
    const Vec3 q = mesh.vertices[b] - center;
    const Vec3 r = mesh.vertices[c] - center;
    const Vec3 cross = (q - p).cross(r - p);
    const double length = cross.norm();
    mesh.normals.push_back(length > 0 ? Vec3(cross / length) : Vec3(Vec3::Zero()));
    mesh.areas.push_back(length / 2);
    mesh.total_area += length / 2;
    mesh.volume += p.dot(q.cross(r)) / 6;
  }
  return mesh;
}

std::vector<Edge> build_edges(const Mesh& mesh) {
  struct Side {
    int a, b, triangle;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  sides.reserve(mesh.triangles.size() * 3);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k];
      const int b = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), t});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<Edge> edges;
  edges.reserve(sides.size() / 2);
  for (const Side& side : sides) {
    if (edges.empty() || edges.back().a != side.a || edges.back().b != side.b) {
      edges.push_back({side.a, side.b, {}});
    }
    edges.back().triangles.push_back(side.triangle);
  }
  return edges;
}

}  // namespace hewn
