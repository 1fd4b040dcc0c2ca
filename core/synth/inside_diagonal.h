#pragma once
/// How large a solid is, whatever its primitives are.
#include "core/csg/tree.h"
#include "core/sample/arrangement.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

/// The diagonal of the solid, by lines through its cells; 0 when no cell is inside. Boxes of trees
/// with redundant parts can be far larger than their solids.
double diagonal_of_inside(const Tree& tree, const Arrangement& arrangement, const Column& inside);

}  // namespace hewn
