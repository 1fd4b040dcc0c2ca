#pragma once
/// Terms that end with the solid or soon behind it.
#include "core/fit/surface_set.h"
#include "core/synth/decompose/decision_list.h"

namespace hewn {

/// Bounds filling terms by planes that take nothing of the solid from them, as long as the list
/// stays right and costs no more: a post that is cut down to the plate it stands in becomes as high
/// as the plate. Drops items that are then of no use. Of cutting terms it finds out where their
/// work ends (`Term::work_ends`). Requires: a right list. Cost: O(items x planes x words), a few
/// times over.
void tighten_list(const SearchSpace& space, const SurfaceSet& surfaces, DecisionList& list);

}  // namespace hewn
