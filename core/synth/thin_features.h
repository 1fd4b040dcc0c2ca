#pragma once
/// What a tolerance let go: the thin parts and gaps in which two solids differ.
#include <vector>

#include "core/csg/tree.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

/// A part of the solid that went, or a gap in it that was filled.
struct ThinFeature {
  bool is_filled = false;
  Vec3 at = Vec3::Zero();  ///< a point of its thickest cell
  double thickness = 0;    ///< twice the distance from `at` to the solid's surface; model units
  std::size_t cells = 0;
};

/// The `changed` cells, those that touch taken together: cells whose signatures differ in one
/// literal. `wanted` tells which cells the solid of `tree` holds. Thickest first.
/// Cost: O(changed cells^2 x words of a signature).
std::vector<ThinFeature> thin_features(const Tree& tree, const Arrangement& arrangement,
                                       const Column& wanted, const Column& changed);

}  // namespace hewn
