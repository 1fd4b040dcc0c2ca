#pragma once
/// Stage 4: principal curvatures of triangles (Rusinkiewicz 2004).
#include <vector>

#include "core/segment/curvature/group_normals.h"

namespace hewn {

/// Curvatures are in 1 / model units, positive where the solid is convex.
struct PrincipalCurvatures {
  double max = 0;                      ///< kappa_max: the one of larger magnitude
  double min = 0;                      ///< kappa_min: the one of smaller magnitude
  Vec3 max_direction = Vec3::UnitX();  ///< unit tangent along which `max` is measured

  double mean() const { return (max + min) / 2; }
};

/// Finite differences of the corners' normals along the three sides give each triangle a curvature
/// tensor by least squares; the tensors are averaged at vertices, weighted by each corner's share
/// of the area, but never across a marked edge; a triangle takes the mean of its corners.
/// Fails with: Cancelled. Cost: O(n). Same result for any thread count.
Result<std::vector<PrincipalCurvatures>> compute_principal_curvatures(
    const Mesh& mesh, const TriangleTopology& topology, const GroupNormals& normals,
    const RunContext& run);

}  // namespace hewn
