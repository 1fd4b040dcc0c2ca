// What is wrong with the surface, counted.
#include <algorithm>

#include <fmt/format.h>

#include "core/base/counted.h"
#include "core/mesh/edge_use.h"
#include "core/mesh/index_groups.h"
#include "core/mesh/repair.h"

namespace hewn {
namespace {

int count_loops(const std::vector<EdgeSide>& boundary, std::size_t vertices) {
  IndexGroups groups(vertices);
  for (const EdgeSide& side : boundary) groups.join(side.low(), side.high());
  std::vector<int> roots;
  roots.reserve(boundary.size());
  for (const EdgeSide& side : boundary) roots.push_back(groups.root(side.low()));
  std::sort(roots.begin(), roots.end());
  return static_cast<int>(std::unique(roots.begin(), roots.end()) - roots.begin());
}

}  // namespace

void check_topology(const Soup& soup, std::span<const EdgeSide> sides, MeshReport& report) {
  IndexGroups groups(soup.triangles.size());
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
    report.warnings.push_back(fmt::format(
        "The surface is open: {} around {}; what lies inside is decided by the majority "
        "of rays.",
        counted(report.boundary_edges, "boundary edge", "boundary edges"),
        counted(report.holes, "hole", "holes")));
  }
  if (report.non_manifold_edges > 0) {
    report.warnings.push_back(counted(report.non_manifold_edges, "edge has", "edges have") +
                              " more than two triangles: solids touch there, or sheets end.");
  }
  if (report.components > 1) {
    report.warnings.push_back(fmt::format("The mesh has {} separate parts.", report.components));
  }
}

}  // namespace hewn
