#pragma once
/// Arcs too short to tell their own axis, as the ground between a gear's teeth: they take the axis
/// of another surface when their vertices lie exactly on a circle about it.
#include <vector>

#include "core/fit/fit_items.h"
#include "core/fit/snap_rule.h"

namespace hewn {

/// Gives cylinders whose fit is loose the axis of a sure one, or the one that fits all loose ones
/// of their direction together. Vertices cut by neighbouring faces lie on chords and drag a fit;
/// those on the circle itself agree to rounding, which three of them do by chance about no other
/// axis. `exact`: how far vertices on a surface are off, model units. Requires: items have their
/// cluster's direction. Cost: O(items^2 x points) for the loose ones.
void settle_short_arcs(std::vector<FitItem>& items, const std::vector<Vec3>& directions,
                       const SnapRule& snap, double exact);

}  // namespace hewn
