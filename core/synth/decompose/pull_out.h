#pragma once
/// Holes that several solids of a list share, cut out of all of them at once.
#include "core/synth/decompose/decision_list.h"

namespace hewn {

/// Cuts a literal that filled terms are less by first of all, instead of in each of them, as in
/// (A - X) + (B - X) = (A + B) - X; and leaves out what the terms then need not exclude. A walk
/// seldom gets there: half of the way is no cheaper. False when nothing is cheaper in the end.
/// Requires: a right list. Cost: O(different literals x items x words) at most; few in practice.
bool pull_out_cuts(const SearchSpace& space, DecisionList& list);

}  // namespace hewn
