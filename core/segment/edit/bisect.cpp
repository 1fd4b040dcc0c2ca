#include "core/segment/edit/bisect.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/segment/measure_group.h"

namespace hewn {
namespace {

/// Where a vertex or a piece of a triangle lies: -1 behind, 0 on, +1 before the plane.
using Side = int;

/// Splits triangles along the plane. Only edges of chosen triangles are cut, but for all of the
/// triangles around them.
class Splitter {
 public:
  Splitter(const Mesh& mesh, const CutPlane& plane, double tolerance)
      : mesh_(mesh), vertices_(mesh.vertices), side_(mesh.vertices.size()) {
    height_.reserve(mesh.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      height_.push_back(plane.normal.dot(mesh.vertices[v]) - plane.offset);
      side_[v] = height_[v] > tolerance ? 1 : height_[v] < -tolerance ? -1 : 0;
    }
  }

  /// Makes one new vertex on each edge that crosses the plane beside a chosen triangle.
  void cut_edges(const std::vector<bool>& is_chosen) {
    for (const Edge& edge : build_edges(mesh_)) {
      if (side_[edge.a] * side_[edge.b] >= 0) continue;
      const bool is_beside_chosen = std::any_of(edge.triangles.begin(), edge.triangles.end(),
                                                [&](int t) { return is_chosen[t]; });
      if (!is_beside_chosen) continue;
      const double share = height_[edge.a] / (height_[edge.a] - height_[edge.b]);
      const Vec3& a = mesh_.vertices[edge.a];
      cuts_.push_back({edge.a, edge.b, static_cast<int>(vertices_.size())});
      vertices_.emplace_back(a + (mesh_.vertices[edge.b] - a) * share);
    }
  }

  void split_all() {
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) split(t);
  }

  Mesh finish() { return make_mesh(std::move(vertices_), std::move(triangles_)); }
  /// For each new triangle, the one that it is a piece of.
  const std::vector<int>& source() const { return source_; }
  /// Of each new triangle; +1 for one that lies in the plane.
  const std::vector<Side>& sides() const { return piece_side_; }

 private:
  struct Cut {
    int a, b, vertex;
  };

  /// The new vertex on an edge, -1 where it is not cut. `cuts_` is ordered by (a, b).
  int cut_on(int a, int b) const {
    if (side_[a] * side_[b] >= 0) return -1;
    const std::pair<int, int> key = std::minmax(a, b);
    const auto found =
        std::lower_bound(cuts_.begin(), cuts_.end(), key,
                         [](const Cut& cut, const auto& k) { return std::pair(cut.a, cut.b) < k; });
    const bool is_cut = found != cuts_.end() && found->a == key.first && found->b == key.second;
    return is_cut ? found->vertex : -1;
  }

  void add(const Triangle& triangle, int source) {
    Side side = 0;
    for (const int v : triangle) {
      if (v < static_cast<int>(side_.size()) && side_[v] != 0) side = side_[v];
    }
    triangles_.push_back(triangle);
    source_.push_back(source);
    piece_side_.push_back(side < 0 ? -1 : 1);
  }

  void split(int t) {
    const Triangle& triangle = mesh_.triangles[t];
    std::array<int, 3> cut;
    int cut_count = 0;
    for (int k = 0; k < 3; ++k) {
      cut[k] = cut_on(triangle[k], triangle[(k + 1) % 3]);
      cut_count += cut[k] >= 0 ? 1 : 0;
    }
    if (cut_count == 0) return add(triangle, t);
    for (int k = 0; k < 3; ++k) {
      const int p = triangle[k];
      const int q = triangle[(k + 1) % 3];
      const int r = triangle[(k + 2) % 3];
      const int before = cut[(k + 2) % 3];
      if (cut_count == 1 && cut[k] >= 0) {
        add({p, cut[k], r}, t);
        add({cut[k], q, r}, t);
      } else if (cut_count == 2 && cut[k] >= 0 && before >= 0) {
        add({p, cut[k], before}, t);
        add_quad({cut[k], q, r, before}, t);
      }
    }
  }

  /// Along the shorter diagonal, for better shapes.
  void add_quad(const std::array<int, 4>& v, int source) {
    const double first = (vertices_[v[0]] - vertices_[v[2]]).squaredNorm();
    const double second = (vertices_[v[1]] - vertices_[v[3]]).squaredNorm();
    if (first <= second) {
      add({v[0], v[1], v[2]}, source);
      add({v[0], v[2], v[3]}, source);
    } else {
      add({v[0], v[1], v[3]}, source);
      add({v[1], v[2], v[3]}, source);
    }
  }

  const Mesh& mesh_;
  std::vector<Vec3> vertices_;
  std::vector<Side> side_;
  std::vector<double> height_;
  std::vector<Cut> cuts_;
  std::vector<Triangle> triangles_;
  std::vector<int> source_;
  std::vector<Side> piece_side_;
};

/// Numbers for the parts of groups or facets: the old index where one stays whole or lies before
/// the plane; new ones, appended in ascending order, for the parts behind.
class Halves {
 public:
  Halves(std::size_t count, const std::vector<int>& of_old_triangle, const Splitter& pieces,
         const std::vector<bool>& is_chosen)
      : behind_(count, -1) {
    constexpr int kBefore = 1;
    constexpr int kBehind = 2;
    std::vector<int> seen(count, 0);
    for (std::size_t i = 0; i < pieces.source().size(); ++i) {
      const int source = pieces.source()[i];
      const int old = of_old_triangle[source];
      if (old >= 0 && is_chosen[source]) seen[old] |= pieces.sides()[i] > 0 ? kBefore : kBehind;
    }
    for (std::size_t old = 0; old < count; ++old) {
      if (seen[old] != (kBefore | kBehind)) continue;
      behind_[old] = static_cast<int>(count + appended_.size());
      appended_.push_back(static_cast<int>(old));
    }
    for (std::size_t i = 0; i < pieces.source().size(); ++i) {
      const int source = pieces.source()[i];
      const int old = of_old_triangle[source];
      const bool is_behind = old >= 0 && is_chosen[source] && pieces.sides()[i] < 0;
      part_.push_back(is_behind && behind_[old] >= 0 ? behind_[old] : old);
    }
  }
  /// For each new triangle.
  const std::vector<int>& part() const { return part_; }
  /// The old indices of the appended parts.
  const std::vector<int>& appended() const { return appended_; }

 private:
  std::vector<int> behind_, part_, appended_;
};

void rebuild_groups(const Segmentation& before, const Halves& halves, EditedSegmentation& out) {
  Segmentation& after = out.segmentation;
  after.groups = before.groups;
  for (int g = 0; g < static_cast<int>(before.groups.size()); ++g) out.source_group.push_back(g);
  for (const int g : halves.appended()) {
    after.groups.push_back(before.groups[g]);
    out.source_group.push_back(g);
  }
  for (FaceGroup& group : after.groups) group.triangles.clear();
  after.group_of_triangle = halves.part();
  for (int t = 0; t < static_cast<int>(halves.part().size()); ++t) {
    if (halves.part()[t] >= 0) after.groups[halves.part()[t]].triangles.push_back(t);
  }
  for (FaceGroup& group : after.groups) measure_group(out.mesh, group);
}

void rebuild_facets(const Mesh& mesh, const Segmentation& before, const Halves& halves,
                    Segmentation& after) {
  after.facets = before.facets;
  for (const int f : halves.appended()) after.facets.push_back(before.facets[f]);
  for (Facet& facet : after.facets) facet.triangles.clear();
  after.facet_of_triangle = halves.part();
  for (int t = 0; t < static_cast<int>(halves.part().size()); ++t) {
    if (halves.part()[t] >= 0) after.facets[halves.part()[t]].triangles.push_back(t);
  }
  for (Facet& facet : after.facets) {
    facet.area = 0;
    Vec3 moment = Vec3::Zero();
    for (const int t : facet.triangles) {
      facet.area += mesh.areas[t];
      moment += mesh.areas[t] * mesh.centroid(t);
    }
    if (facet.area > 0) facet.centroid = moment / facet.area;
  }
}

}  // namespace

Result<EditedSegmentation> bisect_groups(const Mesh& mesh, const Segmentation& segmentation,
                                         std::span<const int> groups, const CutPlane& plane,
                                         const BisectOptions& options, const RunContext& run) {
  if (!(std::abs(plane.normal.norm() - 1) <= 1e-9) || !std::isfinite(plane.offset)) {
    return Error{ErrorCode::InvalidArgument,
                 "the cut plane needs a normal of length 1 and a finite offset"};
  }
  if (const auto checked = check_groups(segmentation, groups); !checked) return checked.error();
  std::vector<bool> is_chosen(mesh.triangles.size(), false);
  for (const int g : groups) {
    for (const int t : segmentation.groups[g].triangles) is_chosen[t] = true;
  }
  Splitter splitter(mesh, plane, options.snap * mesh.diagonal());
  splitter.cut_edges(is_chosen);
  if (run.is_cancelled()) return RunContext::cancelled();
  splitter.split_all();

  EditedSegmentation out;
  out.mesh = splitter.finish();
  out.source_triangle = splitter.source();
  out.segmentation.noise = segmentation.noise;
  rebuild_groups(
      segmentation,
      Halves(segmentation.groups.size(), segmentation.group_of_triangle, splitter, is_chosen), out);
  if (!segmentation.facets.empty()) {
    const Halves halves(segmentation.facets.size(), segmentation.facet_of_triangle, splitter,
                        is_chosen);
    rebuild_facets(out.mesh, segmentation, halves, out.segmentation);
  }
  if (run.is_cancelled()) return RunContext::cancelled();
  return out;
}

}  // namespace hewn
