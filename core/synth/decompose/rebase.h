#pragma once
/// A list that takes everything off a whole box, as one that begins with a solid of its own.
#include "core/synth/decompose/decision_list.h"

namespace hewn {

/// By De Morgan's law: where halfspaces are cut off what is filled at first, an intersection that
/// ends with their surfaces is filled instead, as a disc for a box less all outside a cylinder.
/// Walks do not get there: they leave the base as it is. False when that is not cheaper or would
/// not be right. Requires: a right list. Cost: O(items x words).
bool rebase_list(const SearchSpace& space, DecisionList& list);

}  // namespace hewn
