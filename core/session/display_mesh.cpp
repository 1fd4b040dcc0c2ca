#include "core/session/display_mesh.h"

#include <algorithm>

#include "core/mesh/edge_use.h"
#include "core/segment/triangle_topology.h"

namespace hewn {
namespace {

constexpr double kCreaseCosine = 0.766;  // 40 degrees: facets of one round face stay below
/// Vertices this near the plane (share of the diagonal) lie on neither side.
constexpr double kOnPlane = 1e-6;

std::array<float, 3> single(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Vec3 corner_normal(const Mesh& mesh, const std::vector<int>& labels,
                   const TriangleTopology& topology, int triangle, int k) {
  const Vec3& own = mesh.normals[triangle];
  Vec3 sum = Vec3::Zero();
  for (const int corner : topology.corners_at(mesh.triangles[triangle][k])) {
    const int other = corner / 3;
    if (labels[other] != labels[triangle]) continue;
    if (mesh.normals[other].dot(own) < kCreaseCosine) continue;
    const int c = corner % 3;
    const Vec3 a = mesh.corner(other, (c + 1) % 3) - mesh.corner(other, c);
    const Vec3 b = mesh.corner(other, (c + 2) % 3) - mesh.corner(other, c);
    sum += mesh.normals[other] * std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return sum.norm() > 0 ? Vec3(sum.normalized()) : own;
}

void add_lines(const Mesh& mesh, const std::vector<int>& labels, DisplayMesh& out) {
  const std::vector<EdgeSide> sides = sorted_sides(mesh.triangles);
  for_each_edge(std::span<const EdgeSide>(sides), [&](std::span<const EdgeSide> edge) {
    const int first = labels[edge.front().triangle()];
    int second = first;
    for (const EdgeSide& side : edge) {
      if (labels[side.triangle()] != first) second = labels[side.triangle()];
    }
    if (second == first && edge.size() != 1) return;
    for (const int v : {edge.front().low(), edge.front().high()}) {
      out.lines.push_back({single(mesh.vertices[v] - out.origin), {first, second}});
    }
  });
}

}  // namespace

DisplayMesh build_display_mesh(const Mesh& mesh, const std::vector<int>& labels) {
  DisplayMesh out;
  out.bounds = mesh.bounds;
  out.origin = mesh.bounds.is_empty() ? Vec3(Vec3::Zero()) : mesh.bounds.center();
  const TriangleTopology topology = build_topology(mesh);
  out.corners.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const int t = static_cast<int>(i);
    if (mesh.areas[t] <= 0) continue;
    out.triangles.push_back(t);
    out.labels = std::max(out.labels, labels[t] + 1);
    for (int k = 0; k < 3; ++k) {
      out.corners.push_back({single(mesh.corner(t, k) - out.origin),
                             single(corner_normal(mesh, labels, topology, t, k)), labels[t], 0.0F});
    }
  }
  add_lines(mesh, labels, out);
  return out;
}

DisplayMesh build_display_mesh(const PreparedMesh& prepared) {
  return build_display_mesh(*prepared.mesh, prepared.segmentation.group_of_triangle);
}

int groups_crossed(const PreparedMesh& prepared, const std::vector<int>& groups, const Vec3& normal,
                   double offset) {
  const Mesh& mesh = *prepared.mesh;
  const double reach = kOnPlane * mesh.diagonal();
  int count = 0;
  for (const int g : groups) {
    bool above = false;
    bool below = false;
    for (const int t : prepared.segmentation.groups[g].triangles) {
      for (int k = 0; k < 3; ++k) {
        const double height = normal.dot(mesh.corner(t, k)) - offset;
        above |= height > reach;
        below |= height < -reach;
      }
      if (above && below) break;
    }
    count += above && below;
  }
  return count;
}

}  // namespace hewn
