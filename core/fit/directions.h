#pragma once
/// Makes the axes and normals of a part parallel and orthogonal.
#include <vector>

#include "core/fit/fit_items.h"
#include "core/fit/surface_set.h"

namespace hewn {

/// Clusters the items' axes and normals, snaps the clusters to the coordinate axes, to each other
/// (orthogonal) and to round angles, and sets `FitItem::direction`. No surface's far end moves by
/// more than `options.snap_distance`. Coordinate axes are returned as exact unit vectors; a
/// rotated part's own frame becomes exactly orthogonal.
std::vector<Vec3> assign_directions(std::vector<FitItem>& items, double diagonal,
                                    const RegulariseOptions& options);

/// Two directions across `axis`, used to round positions and to measure facets' phases. `u` is the
/// cyclically next coordinate axis for a coordinate axis, else the coordinate axis across `axis`
/// if there is one, else any.
Tangents reference_frame(const Vec3& axis);

/// Whether `axis` has a coordinate axis exactly across it, so that positions along its reference
/// frame are numbers that a designer may have typed.
bool has_reference(const Vec3& axis);

}  // namespace hewn
