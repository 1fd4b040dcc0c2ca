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

/// How many lines look for the boundary.
struct BoundaryLines {
  std::size_t through_points;  ///< at most, four through each
  std::size_t least_random;
  std::size_t most_random;
  std::size_t per_literal;  ///< random ones
  std::size_t most_hits;    ///< kept of each halfspace
};
/// Enough to search with what they hit.
inline constexpr BoundaryLines kManyLines{12'000, 200, 3000, 40, 200};
/// Enough to see nearly all surfaces of a part.
inline constexpr BoundaryLines kFewLines{3000, 100, 500, 2, 8};

/// Hits of lines through the given points and of random ones. Cost: O(lines x literals).
std::vector<BoundaryHit> boundary_hits(const TreeRays& rays, const TreeSurfaces& surfaces,
                                       const std::vector<Vec3>& points, const BoundaryLines& lines,
                                       const RunContext& run);

/// Whether the solid's label at `p` is free: its surface is no further than `depth`.
bool is_free(const TreeRays& rays, const Vec3& p, double depth);

}  // namespace hewn
