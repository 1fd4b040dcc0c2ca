#include "core/session/display_mesh.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

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

/// Corners of one vertex with equal normals and labels are one.
class CornerWelder {
 public:
  CornerWelder(const Mesh& mesh, DisplayMesh& out)
      : mesh_(mesh), out_(out), last_(mesh.vertices.size(), kNone) {}

  std::uint32_t add(int vertex, const std::array<float, 3>& normal, int label) {
    for (std::uint32_t c = last_[vertex]; c != kNone; c = previous_[c]) {
      if (out_.corners[c].normal == normal && out_.corners[c].label == label) return c;
    }
    const auto added = static_cast<std::uint32_t>(out_.corners.size());
    out_.corners.push_back({single(mesh_.vertices[vertex] - out_.origin), normal, label, 0.0F});
    out_.vertices.push_back(vertex);
    previous_.push_back(std::exchange(last_[vertex], added));
    return added;
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  const Mesh& mesh_;
  DisplayMesh& out_;
  std::vector<std::uint32_t> last_;      ///< corner that was added last at each vertex
  std::vector<std::uint32_t> previous_;  ///< at the same vertex, for each corner
};

/// Whether as many triangles run along the edge in one direction as in the other.
bool is_seen_from_one_side(std::span<const EdgeSide> edge) {
  const auto reversed = std::count_if(edge.begin(), edge.end(),
                                      [](const EdgeSide& side) { return side.is_reversed(); });
  return 2 * static_cast<std::size_t>(reversed) == edge.size();
}

/// The corner that stands for all corners of its label in one cell of a grid (vertex clustering,
/// Rossignac and Borrel 1993); of those on a line between faces when there are any, so that the
/// faces' outlines stay.
std::vector<std::uint32_t> cluster(const DisplayMesh& mesh, double cell) {
  struct Entry {
    std::int32_t label;
    std::array<std::int32_t, 3> cell;
    bool is_inside;  ///< on no line
    std::uint32_t corner;
    auto operator<=>(const Entry&) const = default;
  };
  const auto last = std::max_element(mesh.vertices.begin(), mesh.vertices.end());
  std::vector<int> corners_at(static_cast<std::size_t>(*last) + 1, 0);
  for (const std::int32_t v : mesh.vertices) ++corners_at[v];
  std::vector<Entry> entries;
  entries.reserve(mesh.corners.size());
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const DisplayCorner& corner = mesh.corners[i];
    Entry entry{corner.label, {}, corners_at[mesh.vertices[i]] == 1, static_cast<std::uint32_t>(i)};
    for (std::size_t k = 0; k < 3; ++k) {
      entry.cell[k] = static_cast<std::int32_t>(std::floor(corner.position[k] / cell));
    }
    entries.push_back(entry);
  }
  std::sort(entries.begin(), entries.end());
  std::vector<std::uint32_t> chosen(mesh.corners.size());
  std::size_t first = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool is_same =
        entries[i].label == entries[first].label && entries[i].cell == entries[first].cell;
    if (!is_same) first = i;
    chosen[entries[i].corner] = entries[first].corner;
  }
  return chosen;
}

void add_coarse(DisplayMesh& mesh) {
  if (mesh.indices.size() <= 3 * kManyTriangles) return;
  for (double cells = 320; cells >= 40; cells /= 1.4) {
    const auto chosen = cluster(mesh, mesh.bounds.diagonal() / cells);
    mesh.coarse.clear();
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const std::uint32_t a = chosen[mesh.indices[i]];
      const std::uint32_t b = chosen[mesh.indices[i + 1]];
      const std::uint32_t c = chosen[mesh.indices[i + 2]];
      if (a == b || b == c || c == a) continue;
      mesh.coarse.insert(mesh.coarse.end(), {a, b, c});
    }
    if (mesh.coarse.size() <= 3 * kManyTriangles / 2) return;
  }
}

void add_lines(const Mesh& mesh, const std::vector<int>& labels, DisplayMesh& out) {
  const std::vector<EdgeSide> sides = sorted_sides(mesh.triangles);
  out.is_closed = !sides.empty();
  for_each_edge(std::span<const EdgeSide>(sides), [&](std::span<const EdgeSide> edge) {
    const int first = labels[edge.front().triangle()];
    int second = first;
    for (const EdgeSide& side : edge) {
      if (labels[side.triangle()] != first) second = labels[side.triangle()];
    }
    out.is_closed &= is_seen_from_one_side(edge);
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
  CornerWelder welder(mesh, out);
  out.indices.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const int t = static_cast<int>(i);
    if (mesh.areas[t] <= 0) continue;
    out.labels = std::max(out.labels, labels[t] + 1);
    for (int k = 0; k < 3; ++k) {
      const auto normal = single(corner_normal(mesh, labels, topology, t, k));
      out.indices.push_back(welder.add(mesh.triangles[t][k], normal, labels[t]));
    }
  }
  add_lines(mesh, labels, out);
  add_coarse(out);
  return out;
}

DisplayMesh build_display_mesh(const TreeBoundary& boundary) {
  DisplayMesh out;
  for (const BoundaryCorner& c : boundary.corners) out.bounds.extend(c.position);
  out.origin = out.bounds.is_empty() ? Vec3(Vec3::Zero()) : out.bounds.center();
  for (const BoundaryCorner& c : boundary.corners) {
    const auto i = static_cast<std::int32_t>(out.corners.size());
    out.corners.push_back({single(c.position - out.origin), single(c.normal), c.label, 0.0F});
    out.vertices.push_back(i);
    out.indices.push_back(static_cast<std::uint32_t>(i));
    out.labels = std::max(out.labels, c.label + 1);
  }
  for (const BoundaryLine& l : boundary.lines) {
    for (const Vec3& end : {l.from, l.to}) {
      out.lines.push_back({single(end - out.origin), {l.label, l.label}});
    }
  }
  add_coarse(out);
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
