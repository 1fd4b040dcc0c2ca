#pragma once
/// Ends of bars that vanish in the rest of the part: spokes, rods and oblique holes.
#include <vector>

#include "core/sample/sample_table.h"

namespace hewn {

/// Planes across bars, where they end. The sides of a bar that runs into a hub tell its direction,
/// but no face tells where it ends: without a plane there, terms have to borrow surfaces of other
/// directions, each for one more primitive; with it, the bar is one box. The same holds for a rod,
/// and for a hole that ends in a bore.
///
/// Bars are those of `find_bars`. A plane lies at a round place where the bar goes on unseen for a
/// while, but not to the end of the part. Not where a plane of the part across the bar lies there
/// or further on: that one ends it as well. None when there are too many. New directions are
/// appended to `surfaces.directions`. Cost: that of `find_bars`, and some hundred labels for each
/// bar.
std::vector<Halfspace> bar_ends(const SampleSpace& space, SurfaceSet& surfaces);

}  // namespace hewn
