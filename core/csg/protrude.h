#pragma once
/// Cutting tools that stick out of what they cut.
#include "core/csg/tree.h"

namespace hewn {

/// The same solid with the flat ends of subtracted boxes and cylinders moved out where they lie in
/// the surface of the solid they cut and nothing is behind them, by a round amount of at most a
/// tenth of the tree's diagonal. Flush tools leave zero-thickness sheets in programs that do not
/// compute exactly (OpenSCAD's preview among them). Only tools that are single literals are moved.
/// Features of the solid thinner than 1/128 of the diagonal may be missed behind an end.
/// Cost: O(flush ends x 10^4) distances of the cut solid at most.
Tree with_protruding_tools(const Tree& tree);

}  // namespace hewn
