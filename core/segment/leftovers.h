#pragma once
/// What no curved surface took: slivers, planes, and patches that are flat but for noise.
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/segment/curved_growth.h"

namespace hewn {

/// Gives slivers without a usable normal to a curved neighbour on whose surface they lie.
void absorb_slivers(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                    FacetGroups& found);

/// Gives free facets to a curved group found elsewhere when they are facets of its tessellation:
/// other faces may cut a surface into pieces too small to be recognised on their own. Stops when
/// cancelled.
void adopt_facets(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                  FacetGroups& found, const RunContext& run);

/// Turns every free facet into a plane, largest first, together with free neighbours that are
/// coplanar but for noise.
Result<void> plane_leftovers(const Mesh& mesh, const FacetGraph& graph,
                             const SurfaceTolerance& tolerance, FacetGroups& found,
                             const RunContext& run);

/// Joins groups that lie within the depth of a larger curved group's facets to it, and refits it.
/// For resampled meshes only: there one surface is often found in several pieces. Stops when
/// cancelled.
void merge_pieces(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                  FacetGroups& found, const RunContext& run);

/// Dissolves small groups whose normals mean nothing, for the noise or because a resampled mesh's
/// triangles straddle an edge, into neighbours on whose surfaces they lie; and single crooked
/// triangles that a modeller left where it lost a vertex into what they lie close to.
void dissolve_splinters(const Mesh& mesh, const FacetGraph& graph,
                        const SurfaceTolerance& tolerance, FacetGroups& found);

}  // namespace hewn
