#pragma once
/// Finds the curved surfaces of a facet graph: seeds, growth with incremental fits, best first.
#include <optional>
#include <vector>

#include "core/base/rng.h"
#include "core/base/run_context.h"
#include "core/segment/facet_fit.h"
#include "core/segment/segment.h"

namespace hewn {

/// A surface with the facets found on it.
struct GrownGroup {
  Surface surface;
  std::vector<int> facets;
  /// The surface follows from the facets' planes; fits to vertices would only spoil it.
  bool is_settled = false;
};

/// Grows curved groups in every smooth component of the facet graph. `group_of_facet` (-1: free)
/// is read and updated with indices into `groups`, to which the new ones are appended. Returns the
/// number of components that were given up as free-form: what is left of them stays free.
/// Cost: O(components x rounds x facets of the component).
Result<int> grow_curved_groups(const Mesh& mesh, const FacetGraph& graph,
                               const SurfaceTolerance& tolerance, const SegmentOptions& options,
                               std::vector<GrownGroup>& groups, std::vector<int>& group_of_facet,
                               const RunContext& run);

/// Facets joined by rims that turn by less than `smooth_rad`.
std::vector<std::vector<int>> smooth_components(const FacetGraph& graph, double smooth_rad);

}  // namespace hewn
