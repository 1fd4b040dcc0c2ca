#pragma once
/// Cylinders in meshes that were cut into small triangles after their tessellation.
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/segment/curved_growth.h"

namespace hewn {

/// Finds cylinders from the flat facets of their tessellation: the planes of a regular one all
/// touch the inscribed circle, however the facets were cut up afterwards, while hardly a vertex
/// still lies on the true surface. Facets that are only bridged by triangles across their common
/// edge count as neighbours. Appends groups with the circumscribed radius and takes the triangles
/// across edges with them. Cost: linear in the facets for each cylinder.
/// Fails with: Cancelled.
Result<void> take_plane_rings(const Mesh& mesh, const FacetGraph& graph,
                              const SurfaceTolerance& tolerance, double smooth_rad,
                              FacetGroups& found, const RunContext& run);

}  // namespace hewn
