#include "core/session/flat_faces.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/csg/flat_end.h"
#include "core/segment/triangle_topology.h"

namespace hewn {
namespace {

constexpr double kFlat = 1 - 1e-7;
constexpr std::size_t kEnds = 6;

bool touch(const Box3& a, const Box3& b, double near) {
  return (a.lo.array() <= b.hi.array() + near).all() && (b.lo.array() <= a.hi.array() + near).all();
}

}  // namespace

std::vector<FlatFace> unify_flat_faces(const Mesh& mesh, std::vector<int>& labels) {
  const TriangleTopology topology = build_topology(mesh);
  std::vector<FlatFace> faces;
  std::vector<char> seen(labels.size(), 0);
  std::vector<int> triangles;
  for (std::size_t start = 0; start < labels.size(); ++start) {
    if (seen[start]) continue;
    triangles.assign(1, static_cast<int>(start));
    seen[start] = 1;
    FlatFace face;
    face.normal = mesh.normals[start];
    face.offset = face.normal.dot(mesh.corner(static_cast<int>(start), 0));
    std::map<int, double> areas;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const int t = triangles[i];
      areas[labels[t]] += mesh.areas[t];
      face.area += mesh.areas[t];
      for (int k = 0; k < 3; ++k) face.box.extend(mesh.corner(t, k));
      for (const int next : topology.neighbors[t]) {
        if (next < 0 || seen[next] || mesh.normals[next].dot(mesh.normals[t]) < kFlat) continue;
        seen[next] = 1;
        triangles.push_back(next);
      }
    }
    const auto most = std::max_element(areas.begin(), areas.end(),
                                       [](auto& a, auto& b) { return a.second < b.second; });
    face.label = most->first;
    for (const int t : triangles) labels[t] = face.label;
    faces.push_back(face);
  }
  return faces;
}

std::vector<std::int32_t> shown_labels(const Tree& tree, const std::vector<FlatFace>& faces,
                                       double near) {
  std::vector<std::int32_t> shown;
  for (std::size_t l = 0; l < tree.literals.size(); ++l) {
    const Literal& literal = tree.literals[l];
    shown.insert(shown.end(), kEnds, static_cast<std::int32_t>(l));
    const Box3 bounds = literal.bounds();
    for (const FlatEnd end : flat_ends(literal)) {
      const Vec3 normal = outward_normal(literal, end);
      const double offset = plane_offset(literal, end);
      double largest = 0;
      for (const FlatFace& face : faces) {
        const double cosine = normal.dot(face.normal);  // a tool's end faces the other way
        if (std::abs(cosine) < kFlat || face.area <= largest || face.label < 0) continue;
        if (std::abs(offset - (cosine < 0 ? -face.offset : face.offset)) > near) continue;
        if (!touch(face.box, bounds, near)) continue;
        largest = face.area;
        shown[kEnds * l + static_cast<std::size_t>(2 * end.axis + (end.is_upper ? 1 : 0))] =
            face.label;
      }
    }
  }
  return shown;
}

}  // namespace hewn
