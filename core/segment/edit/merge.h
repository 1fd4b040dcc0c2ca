#pragma once
/// Joins face groups that are one surface.
#include <span>

#include "core/base/run_context.h"
#include "core/segment/edit/edited_segmentation.h"

namespace hewn {

struct MergeOptions {
  double fit_distance = 1e-3;  ///< largest distance of a vertex, as a share of the diagonal
  double fit_normal_deg = 15;  ///< mean angle between triangles and the common surface, at most
};

/// One group from all of `groups`, with a surface fitted to all of its triangles: the simplest kind
/// that keeps to the limits. Where none does, the closest of the groups' own surfaces stays and
/// `is_fitted` becomes false.
///
/// The group takes the lowest of the indices; the others are dropped and later groups move up.
/// Fails with: InvalidArgument (no such group, fewer than two different ones), Cancelled.
Result<EditedSegmentation> merge_groups(const Mesh& mesh, const Segmentation& segmentation,
                                        std::span<const int> groups, const MergeOptions& options,
                                        const RunContext& run);

}  // namespace hewn
