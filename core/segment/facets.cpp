#include "core/segment/facets.h"

#include <algorithm>
#include <utility>

#include "core/mesh/edge_use.h"

namespace hewn {
namespace {

/// Facets around each vertex: 0, 1, 2 or 3 (three and more).
std::vector<unsigned char> count_facets(const Mesh& mesh, const std::vector<int>& facet_of) {
  std::vector<std::array<int, 2>> seen(mesh.vertices.size(), {-1, -1});
  std::vector<unsigned char> count(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const int v : mesh.triangles[t]) {
      const int f = facet_of[t];
      if (seen[v][0] == f || seen[v][1] == f || count[v] == 3) continue;
      if (count[v] < 2) seen[v][count[v]] = f;
      ++count[v];
    }
  }
  return count;
}

}  // namespace

std::vector<std::array<int, 3>> triangle_neighbors(const Mesh& mesh) {
  std::vector<std::array<int, 3>> neighbors(mesh.triangles.size(), {-1, -1, -1});
  const std::vector<EdgeSide> sides = sorted_sides(mesh.triangles);
  for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
    if (edge.size() != 2) return;
    neighbors[edge[0].triangle()][edge[0].corner()] = edge[1].triangle();
    neighbors[edge[1].triangle()][edge[1].corner()] = edge[0].triangle();
  });
  return neighbors;
}

void FacetGraph::collect_corners(const Mesh& mesh,
                                 const std::vector<std::array<int, 3>>& neighbors) {
  const std::vector<unsigned char> count = count_facets(mesh, facet_of_triangle);
  std::vector<bool> is_open(mesh.vertices.size(), false);
  for (std::size_t t = 0; t < neighbors.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (neighbors[t][k] >= 0) continue;
      is_open[mesh.triangles[t][k]] = is_open[mesh.triangles[t][(k + 1) % 3]] = true;
    }
  }
  std::size_t interior = 0;
  for (std::size_t v = 0; v < count.size(); ++v) interior += count[v] == 1 && !is_open[v];
  interior_share = static_cast<double>(interior) / static_cast<double>(count.size());
  corner_begin_.assign(1, 0);
  for (int f = 0; f < size(); ++f) {
    const std::size_t begin = corners_.size();
    for (const int v : vertices(f)) {
      if (count[v] >= 3 || is_open[v]) corners_.push_back(v);
    }
    if (corners_.size() < begin + 3) {
      corners_.resize(begin);
      corners_.insert(corners_.end(), vertices(f).begin(), vertices(f).end());
    }
    corner_begin_.push_back(static_cast<int>(corners_.size()));
  }
  corner_uses_.assign(mesh.vertices.size(), 0);
  for (const int v : corners_) ++corner_uses_[v];
}

void FacetGraph::collect_neighbors(const Mesh& mesh,
                                   const std::vector<std::array<int, 3>>& neighbors) {
  neighbor_begin_.assign(1, 0);
  std::vector<int> slot(facets.size(), -1);
  for (int f = 0; f < size(); ++f) {
    const int begin = static_cast<int>(neighbors_.size());
    for (const int t : facets[f].triangles) {
      for (int k = 0; k < 3; ++k) {
        const int u = neighbors[t][k];
        const int g = u < 0 ? -1 : facet_of_triangle[u];
        if (g < 0 || g == f) continue;
        if (slot[g] < begin) {
          slot[g] = static_cast<int>(neighbors_.size());
          const bool has_normals = !facets[f].normal.isZero() && !facets[g].normal.isZero();
          const double angle =
              has_normals ? angle_between(facets[f].normal, facets[g].normal) : kPi / 2;
          neighbors_.push_back({g, angle, 0});
        }
        neighbors_[slot[g]].length += (mesh.corner(t, k) - mesh.corner(t, (k + 1) % 3)).norm();
      }
    }
    std::sort(neighbors_.begin() + begin, neighbors_.end(),
              [](const FacetNeighbor& a, const FacetNeighbor& b) { return a.facet < b.facet; });
    neighbor_begin_.push_back(static_cast<int>(neighbors_.size()));
    for (int i = begin; i < neighbor_begin_.back(); ++i) slot[neighbors_[i].facet] = -1;
  }
}

FacetGraph build_facets(const FacetMerger& merger, const FacetTolerance& tolerance,
                        const RunContext& run) {
  const Mesh& mesh = merger.mesh();
  const std::vector<std::array<int, 3>>& neighbors = merger.neighbors();
  FacetGraph graph;
  MergedFacets merged = merger.merge(tolerance, run);
  graph.facets = std::move(merged.facets);
  graph.facet_of_triangle = std::move(merged.facet_of_triangle);
  graph.vertices_ = FacetVertices(mesh, graph.facets);
  graph.collect_corners(mesh, neighbors);
  graph.collect_neighbors(mesh, neighbors);
  for (int f = 0; f < graph.size(); ++f) {
    Box3 box;
    for (const int v : graph.corners(f)) box.extend(mesh.vertices[v]);
    const double width = graph.facets[f].area / std::max(box.diagonal(), 1e-300);
    graph.normal_error_rad.push_back(2 * tolerance.noise / std::max(width, 1e-300));
  }
  return graph;
}

}  // namespace hewn
