#pragma once
/// Arcs of regular polygons, as circles become in meshes: the corners alone tell the circle.
#include <vector>

#include "core/fit/fit_items.h"

namespace hewn {

/// Fits cylinders whose fit is loose to the corners of their polygon. Where an arc was cut off by a
/// neighbouring face its vertices lie on sides of the polygon, and drag the fit of a short one far.
/// Corners are told by the sides that meet there; three of equal distance, and all other vertices
/// on the sides between them or on their continuation, leave no doubt. Others stay as they are.
/// `exact`: how far vertices are off, model units; `noise` of the mesh. Requires: items have their
/// cluster's direction. Cost: O(points^2) an item, of at most some hundred points.
void settle_polygon_arcs(std::vector<FitItem>& items, const std::vector<Vec3>& directions,
                         double exact, double noise);

}  // namespace hewn
