#pragma once
/// The published ways to sample a set of literals for its cells (Friedrich et al. 2020, section
/// 5.1). Unlike lines along the faces, they may miss cells smaller than their step; but every
/// literal has a point in its middle, however thin it is.
#include <vector>

#include "core/base/run_context.h"
#include "core/sample/arrangement.h"

namespace hewn {

/// How to find the cells of a set of literals.
enum class CellSampling {
  Lines,   ///< along the faces of the literals: `ArrangementSampler::sample`
  Octree,  ///< hierarchically: `octree_points`
  Grid,    ///< one point for each canonical intersection term met by `grid_points`
};

/// Centres of octrees over the literals' bounds and over the box of all. A cell is divided as long
/// as it is larger than `smallest` and the surface of some literal may pass through it, by that
/// literal's distance; the coarse ones first, about 400,000 in all at most.
/// Same result for any number of threads. Cost: O(cells x literals whose surfaces are near).
std::vector<Vec3> octree_points(const Arrangement& arrangement, double smallest,
                                const RunContext& run);

/// The points of a grid over the box of all literals, at most about 400,000.
/// Requires: step > 0.
std::vector<Vec3> grid_points(const Arrangement& arrangement, double step);

/// Adds the cells found in the given way, `lines` being for lines only; the steps of octree and
/// grid are 1/64 of the scale. Returns how many are new. Fails with: Cancelled.
Result<std::size_t> sample_cells(ArrangementSampler& sampler, CellSampling sampling,
                                 const ArrangementOptions& lines, const RunContext& run);

}  // namespace hewn
