#pragma once
/// Larger primitives where it costs nothing: operands that only touch come to overlap.
#include <vector>

#include "core/base/run_context.h"
#include "core/csg/tree_inside.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

struct GrownTree {
  Tree tree;
  double proximity = 0;
  bool is_changed = false;
};

/// Moves flat ends of boxes and cylinders outward to other parallel planes of the literals: of
/// united primitives through the solid, of subtracted ones through the space outside it, so that
/// the solid stays. Only moves that raise the proximity (Friedrich et al. 2020) are kept.
///
/// `points`: one for each cell. Whether a move is free is judged on random points, so that the
/// result has to be checked. Cost: O(literals^2) measures of proximity.
GrownTree grow_overlaps(const Formula& formula, const std::vector<Literal>& literals,
                        const std::vector<Vec3>& points, const TreeInside& solid,
                        const RunContext& run);

}  // namespace hewn
