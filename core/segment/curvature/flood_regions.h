#pragma once
/// Stage 6a: simple region growing by parallel flooding.
#include <vector>

#include "core/segment/curvature/classify_triangles.h"

namespace hewn {

/// The lowest triangle index of each triangle's region: those of the same class that are reached
/// without crossing a marked edge; -1 for triangles without area.
///
/// The paper spreads the largest index, here it is the smallest; the regions are the same. Labels
/// also jump to their label's label, so that long regions take a logarithmic number of rounds.
/// Fails with: Cancelled. Same result for any thread count.
Result<std::vector<int>> flood_regions(const TriangleTopology& topology,
                                       const Boundaries& boundaries,
                                       const std::vector<CurvatureClass>& classes,
                                       const RunContext& run);

}  // namespace hewn
