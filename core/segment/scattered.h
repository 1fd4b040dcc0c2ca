#pragma once
/// Cylinders of which only scattered facets are left.
#include <vector>

#include "core/segment/curved_growth.h"
#include "core/segment/facet_fit.h"

namespace hewn {

/// Teeth, keys and slots can leave so few facets of a cylinder together that none of them can grow
/// one. About the axis of each cylinder and cone known already, planes at one distance whose
/// azimuths and corners fit a regular tessellation become one cylinder. Indices of groups change.
/// Cost: O(axes x planes log planes).
void gather_scattered(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                      FacetGroups& found);

}  // namespace hewn
