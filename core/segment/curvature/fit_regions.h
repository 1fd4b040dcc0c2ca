#pragma once
/// Stage 6b: region growing based on primitive fitting.
#include <vector>

#include "core/segment/curvature/fit_primitive.h"

namespace hewn {

/// Triangles that one primitive explains. Regions may overlap.
struct FittedRegion {
  Surface surface;
  std::vector<int> triangles;  ///< ascending
};

/// Grows regions from random candidate triangles: first along the direction of maximal curvature
/// (the paper's equation 2.4) to `region_triangles`, then, once the seed's primitive fits, over all
/// neighbours that lie on it. Never crosses a marked edge.
///
/// `is_candidate` has one entry for each triangle; regions hold candidates only. Seeds are drawn
/// with `run.seed`. Fails with: Cancelled. One thread.
Result<std::vector<FittedRegion>> grow_fitted_regions(const CurvatureStages& stages,
                                                      const std::vector<bool>& is_candidate,
                                                      const CurvatureOptions& options,
                                                      const RunContext& run);

}  // namespace hewn
