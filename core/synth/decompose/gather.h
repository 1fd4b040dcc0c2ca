#pragma once
/// Fewer changes between uniting and subtracting, for a tree that is less deeply nested.
#include "core/synth/decompose/decision_list.h"

namespace hewn {

/// Moves items past items of the other kind, next to their own kind, where the list stays right, so
/// that fewer levels of unions and differences remain. Requires: a right list.
/// Cost: O(items^2) evaluations of the list at most; few in practice.
void gather_runs(const SearchSpace& space, DecisionList& list);

/// How often the kind of item changes along the list.
int count_changes(const DecisionList& list);

}  // namespace hewn
