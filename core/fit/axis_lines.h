#pragma once
/// Axes of cylinders, cones and tori as shared lines, with clean positions.
#include <vector>

#include "core/fit/fit_items.h"
#include "core/fit/surface_set.h"

namespace hewn {

/// Refits every item with its direction kept exactly, makes coaxial items share one line, and snaps
/// lines, centres and offsets to round values within the fits' deviations.
void settle_positions(std::vector<FitItem>& items, const std::vector<Vec3>& directions,
                      double diagonal, double noise, const RegulariseOptions& options);

/// Snaps radii to round values and makes nearly equal ones equal.
void settle_radii(std::vector<FitItem>& items, double diagonal, double noise,
                  const RegulariseOptions& options);

}  // namespace hewn
