#pragma once
/// Stage 3: normals at vertices, one for each tentative face group that meets there.
#include <vector>

#include "core/segment/curvature/boundaries.h"

namespace hewn {

struct GroupNormals {
  /// Unit normal at each corner (3 t + k): that of the corner's group at the vertex.
  std::vector<Vec3> normal_of_corner;
  /// The lowest corner number of the same group at the same vertex.
  std::vector<int> sector_of_corner;
};

/// Sums triangle normals around each vertex, separated by the marked edges (paper, equation 2.3).
/// Fails with: Cancelled. Cost: O(n). Same result for any thread count.
Result<GroupNormals> compute_group_normals(const Mesh& mesh, const TriangleTopology& topology,
                                           const Boundaries& boundaries,
                                           const CurvatureOptions& options, const RunContext& run);

}  // namespace hewn
