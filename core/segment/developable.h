#pragma once
/// Cylinders and cones in the place of spheres and tori that explain no more.
#include <vector>

#include "core/segment/curved_growth.h"
#include "core/segment/facet_fit.h"

namespace hewn {

/// One ring of facets, such as a chamfer around a shaft, lies on a cone as well as on a whole
/// family of spheres and tori. Where a cylinder or a cone meets a group's corners as closely as its
/// sphere or torus, it takes its place: designs have chamfers far more often than single rings of
/// a ball, and between two planes it is one solid.
///
/// A ring with a flat face at an end lies on a sphere, too: they are taken apart.
///
/// Two rings of facets one above the other always lie on a torus, too. Unless they are equally
/// wide, as the steps of a tessellation are, each becomes a group of its own; new groups are
/// appended.
void prefer_developable(const Mesh& mesh, const FacetGraph& graph,
                        const SurfaceTolerance& tolerance, FacetGroups& found);

}  // namespace hewn
