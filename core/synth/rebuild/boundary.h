#pragma once
/// Which halfspaces bound a tree's solid, and points on both sides of them. Internal to rebuild.
#include <vector>

#include "core/base/run_context.h"
#include "core/csg/tree_ray.h"
#include "core/synth/rebuild/tree_surfaces.h"

namespace hewn {

/// Where a line meets the boundary of the solid.
struct BoundaryHit {
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< outward
  int halfspace = -1;
};

/// Hits of lines through the given points and of random ones, at most `most` for each halfspace.
/// Cost: O(points x literals).
std::vector<BoundaryHit> boundary_hits(const TreeRays& rays, const TreeSurfaces& surfaces,
                                       const std::vector<Vec3>& points, std::size_t most,
                                       const RunContext& run);

/// Whether the solid's label at `p` is free: its surface is no further than `depth`.
bool is_free(const TreeRays& rays, const Vec3& p, double depth);

}  // namespace hewn
