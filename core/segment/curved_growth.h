#pragma once
/// Finds the curved surfaces of a facet graph: seeds, growth with incremental fits, best first.
#include <optional>
#include <vector>

#include "core/base/rng.h"
#include "core/base/run_context.h"
#include "core/segment/facet_fit.h"
#include "core/segment/facet_groups.h"
#include "core/segment/segment.h"

namespace hewn {

/// Grows curved groups in every smooth component of the facet graph, then coarse ones in what is
/// left over: steps up to 40 degrees between facets whose corners are exact and whose middles are
/// not deep. New groups are appended and take free facets only. Returns the number of components
/// that were given up as free-form: what is left of them stays free. Cost: O(components x rounds x
/// facets of the component).
Result<int> grow_curved_groups(const Mesh& mesh, const FacetGraph& graph,
                               const SurfaceTolerance& tolerance, const SegmentOptions& options,
                               FacetGroups& found, const RunContext& run);

}  // namespace hewn
