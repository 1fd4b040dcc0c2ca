#pragma once
/// Stage 7: from overlapping regions to face groups.
#include <vector>

#include "core/fit/face_groups.h"
#include "core/segment/curvature/fit_regions.h"

namespace hewn {

/// Gives every triangle to the region whose surface it fits best, lets neighbours that lie on one
/// surface become one group, and splits groups into their connected parts.
///
/// What no region claims joins a neighbour within twice the limits, or becomes a group of its own
/// for each run of like curvature: with a primitive where one fits, else with a mean plane and
/// `is_fitted` false. Groups are ordered by their lowest triangle. Triangles without area join a
/// neighbour's group where there is one.
/// Fails with: Cancelled. Same result for any thread count.
Result<Segmentation> resolve_regions(const CurvatureStages& stages,
                                     const std::vector<FittedRegion>& regions,
                                     const CurvatureOptions& options, const RunContext& run);

}  // namespace hewn
