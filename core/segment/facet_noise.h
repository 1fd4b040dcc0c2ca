#pragma once
/// How exact a mesh's vertices are, judged from its flat facets.
#include "core/base/run_context.h"
#include "core/segment/facet_merger.h"

namespace hewn {

/// Standard deviation of the coordinates' own rounding, model units: of single precision when every
/// coordinate is one, of the decimal digits when all have at most seven; 0 when neither shows.
double coordinate_rounding(const Mesh& mesh);

/// Estimates the standard deviation of the vertices about the planes and surfaces they were sampled
/// from, model units: the pooled residual of planes fitted to overdetermined facets. Never below
/// the rounding of the coordinates. Meaningless when cancelled.
double estimate_noise(const FacetMerger& merger, const RunContext& run = {});

}  // namespace hewn
