#pragma once
/// Filling terms that end with the solid, where other terms would cut off what reaches further.
#include "core/fit/surface_set.h"
#include "core/synth/decompose/decision_list.h"

namespace hewn {

/// Bounds filling terms by planes that take nothing of the solid from them, as long as the list
/// stays right and costs no more: a post that is cut down to the plate it stands in becomes as high
/// as the plate. Drops items that are then of no use. Requires: a right list.
/// Cost: O(items x planes x words), a few times over.
void tighten_list(const SearchSpace& space, const SurfaceSet& surfaces, DecisionList& list);

}  // namespace hewn
