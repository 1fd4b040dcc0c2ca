#pragma once
/// Which triangles meet along edges and at vertices.
#include <array>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"

namespace hewn {

/// Adjacency of a mesh, addressed by triangle, side and corner. Side k of a triangle runs from its
/// corner k to corner (k + 1) % 3; corner k of triangle t has the number 3 t + k.
struct TriangleTopology {
  /// The triangle across each side; -1 on a hole's rim and where more than two triangles meet.
  std::vector<std::array<int, 3>> neighbors;
  /// Corner numbers grouped by vertex, ascending; `first_corner[v]` to `first_corner[v + 1]`.
  std::vector<int> corners;
  std::vector<int> first_corner;

  std::span<const int> corners_at(int vertex) const {
    return std::span(corners).subspan(first_corner[vertex],
                                      first_corner[vertex + 1] - first_corner[vertex]);
  }
};

/// Cost: O(n log n).
TriangleTopology build_topology(const Mesh& mesh);

}  // namespace hewn
