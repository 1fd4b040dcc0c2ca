#pragma once
/// Cones by the numbers that a designer types: the radii at their ends, or the half angle and one
/// of them.
#include <vector>

#include "core/fit/fit_items.h"
#include "core/fit/surface_set.h"

namespace hewn {

/// Snaps every cone to round values within its fit's deviations: to the radii at the two planes
/// that cap it, if both are round; else its half angle, and what is rounder of a radius at a cap
/// and the place of its apex along the axis. Requires: planes and axes that are settled.
/// Cost: O(cones x (planes + points)).
void settle_cone_sizes(std::vector<FitItem>& items, double diagonal, double noise,
                       const RegulariseOptions& options);

}  // namespace hewn
