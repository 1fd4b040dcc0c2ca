#pragma once
/// Planar facets: what the designer's tessellator emitted as one flat face, and their adjacency.
#include <array>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/fit/face_groups.h"
#include "core/mesh/mesh.h"
#include "core/segment/facet_merger.h"
#include "core/segment/facet_vertices.h"

namespace hewn {

/// Across each side of each triangle lies one other triangle, or none (-1) on open and non-manifold
/// edges. Side k joins corners k and k + 1. Cost: O(n log n).
std::vector<std::array<int, 3>> triangle_neighbors(const Mesh& mesh);

/// A neighbouring facet across a common rim.
struct FacetNeighbor {
  int facet = 0;
  double angle_rad = 0;  ///< between the two normals
  double length = 0;     ///< of the common rim
};

/// Facets with their corners and neighbours. Treat as immutable once built.
struct FacetGraph {
  std::vector<Facet> facets;
  std::vector<int> facet_of_triangle;
  /// How far the facet's normal may be off through the vertices' noise, radians.
  std::vector<double> normal_error_rad;

  /// Corners where three facets meet, ascending: they lie on the true surface, while other rim
  /// vertices lie on a chord. All vertices for a facet with fewer than three corners.
  std::span<const int> corners(int facet) const { return slice(corners_, corner_begin_, facet); }
  /// All vertices of the facet, ascending.
  std::span<const int> vertices(int facet) const {
    return vertices_.of(static_cast<std::size_t>(facet));
  }
  /// Of how many facets the vertex is a corner.
  int corner_uses(int vertex) const { return corner_uses_[vertex]; }
  std::span<const FacetNeighbor> neighbors(int facet) const {
    return slice(neighbors_, neighbor_begin_, facet);
  }
  /// Share of the vertices that lie inside one flat facet. Next to none in a designer's
  /// tessellation, many in a mesh that was cut into small triangles afterwards.
  double interior_share = 0;
  int size() const { return static_cast<int>(facets.size()); }

 private:
  friend FacetGraph build_facets(const FacetMerger&, const FacetTolerance&, const RunContext&);
  template <class T>
  static std::span<const T> slice(const std::vector<T>& all, const std::vector<int>& begin, int i) {
    return {all.data() + begin[i], static_cast<std::size_t>(begin[i + 1] - begin[i])};
  }
  void collect_corners(const Mesh& mesh, const std::vector<std::array<int, 3>>& neighbors);
  void collect_neighbors(const Mesh& mesh, const std::vector<std::array<int, 3>>& neighbors);

  FacetVertices vertices_;
  std::vector<int> corners_, corner_begin_, corner_uses_, neighbor_begin_;
  std::vector<FacetNeighbor> neighbors_;
};

/// Merges coplanar neighbours. Cost: O(n log n). Incomplete when cancelled.
FacetGraph build_facets(const FacetMerger& merger, const FacetTolerance& tolerance,
                        const RunContext& run = {});

}  // namespace hewn
