#pragma once
/// Stage 2: tentative boundaries between face groups.
#include <array>
#include <vector>

#include "core/segment/curvature/classify_vertices.h"

namespace hewn {

struct Boundaries {
  /// Whether each side of each triangle is marked; both triangles of an edge agree.
  std::vector<std::array<bool, 3>> is_marked;
  /// The paper's k^FG: tentative number of face groups that meet at each vertex, at least 1.
  std::vector<int> group_count;
};

/// Marks edges whose vertices are both no face and whose triangles meet at more than the ridge
/// angle; also hole rims and non-manifold edges. Cost: O(n).
Boundaries find_boundaries(const Mesh& mesh, const TriangleTopology& topology,
                           const std::vector<VertexClass>& classes,
                           const CurvatureOptions& options);

}  // namespace hewn
