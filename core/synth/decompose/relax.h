#pragma once
/// Moving term boundaries out of the way: a boundary that may lie anywhere in a range is put where
/// the tool leaves the solid instead of flush with a face.
#include "core/fit/surface_set.h"
#include "core/synth/decompose/decision_list.h"

namespace hewn {

/// Drops plane literals, or moves them to farther parallel planes, as long as the list stays right
/// and costs no more. Requires: a right list.
void relax_list(const SearchSpace& space, const SurfaceSet& surfaces, DecisionList& list);

}  // namespace hewn
