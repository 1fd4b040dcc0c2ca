#pragma once
/// Where one surface ends and the next begins in a mesh that was cut up after its tessellation.
#include <vector>

#include "core/base/run_context.h"
#include "core/segment/curved_growth.h"

namespace hewn {

/// Moves facets at the border of two groups to the one whose surface they lie on, and refits every
/// group to the facets inside it, in turns: growth cannot tell the first triangles of a tangent
/// plane from those of the fillet, and a fit that holds some of both is good for neither (the idea
/// of Cohen-Steiner et al. 2004, "Variational shape approximation", kept to the borders).
/// For resampled meshes. Cost: O(facets) a round, few rounds. Stops when cancelled.
void relax_borders(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                   FacetGroups& found, const RunContext& run);

}  // namespace hewn
