#pragma once
/// Cylinders and cones of which only short pieces are left.
#include "core/segment/facet_fit.h"
#include "core/segment/facet_groups.h"

namespace hewn {

/// A short piece of a cone, such as the chamfer at one corner of a nut, agrees with many surfaces,
/// and a fit picks any of them. About the axis of each exact cylinder and cone, groups that meet
/// their own surface only loosely are tried as pieces of a cylinder or cone with that axis; pieces
/// of the same one become one group. Indices of groups change. Cost: O(axes x corners).
void adopt_axes(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                FacetGroups& found);

}  // namespace hewn
