#pragma once
/// Ends of bars that vanish in the rest of the part: spokes, ribs and arms at an angle.
#include <vector>

#include "core/sample/sample_table.h"

namespace hewn {

/// Planes across bars, where they end. The sides of a bar that runs into a hub tell its direction,
/// but no face tells where it ends: without a plane there, terms have to borrow surfaces of other
/// directions, each for one more primitive; with it, the bar is one box.
///
/// A bar has four sides around it, with outer edges between them. Only
/// those along a direction that no plane of the part has are of interest. A plane lies at a round
/// place where the bar goes on unseen within the solid. None when there are too many. New
/// directions are appended to `surfaces.directions`. Cost: O(n log n) for n triangles, and some
/// labels for each bar.
std::vector<Halfspace> bar_ends(const SampleSpace& space, SurfaceSet& surfaces);

}  // namespace hewn
