// What is wrong with the surface, counted.
#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "core/mesh/edge_use.h"
#include "core/mesh/repair.h"

namespace hewn {
namespace {

/// Union-find with path halving; the lower index is the root.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    a = root(a);
    b = root(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

int count_loops(const std::vector<EdgeSide>& boundary, std::size_t vertices) {
  Groups groups(vertices);
  for (const EdgeSide& side : boundary) groups.join(side.low(), side.high());
  std::vector<int> roots;
  for (const EdgeSide& side : boundary) roots.push_back(groups.root(side.low()));
  std::sort(roots.begin(), roots.end());
  return static_cast<int>(std::unique(roots.begin(), roots.end()) - roots.begin());
}

}  // namespace

void check_topology(const Soup& soup, MeshReport& report) {
  const std::vector<EdgeSide> sides = sorted_sides(soup.triangles);
  Groups groups(soup.triangles.size());
  std::vector<EdgeSide> boundary;
  report.is_closed = true;
  for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
    for (const EdgeSide& side : edge) groups.join(edge[0].triangle(), side.triangle());
    if (edge.size() == 1) boundary.push_back(edge[0]);
    if (edge.size() > 2) ++report.non_manifold_edges;
    if (edge.size() % 2 != 0) report.is_closed = false;
  });
  for (int t = 0; t < static_cast<int>(soup.triangles.size()); ++t) {
    if (groups.root(t) == t) ++report.components;
  }
  report.boundary_edges = static_cast<int>(boundary.size());
  report.holes = count_loops(boundary, soup.vertices.size());
  if (report.boundary_edges > 0) {
    report.warnings.push_back(
        fmt::format("The surface is open: {} boundary edges around {} holes; what lies inside is "
                    "decided by the majority of rays.",
                    report.boundary_edges, report.holes));
  }
  if (report.non_manifold_edges > 0) {
    report.warnings.push_back(
        fmt::format("{} edges have more than two triangles.", report.non_manifold_edges));
  }
  if (report.components > 1) {
    report.warnings.push_back(fmt::format("The mesh has {} separate parts.", report.components));
  }
}

}  // namespace hewn
