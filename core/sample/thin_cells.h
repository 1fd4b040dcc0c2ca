#pragma once
/// Cells that are nothing but skin: all of their points lie next to the solid's surface.
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/csg/tree.h"
#include "core/sample/arrangement.h"

namespace hewn {

struct CellDepth {
  bool is_thin = true;
  Vec3 point = Vec3::Zero();  ///< of a cell that is not thin: one that lies deep
};

/// For each of `cells`: whether no point was found further than `depth` from the surface of `tree`.
/// Looks at the cell's point and at the middles of a few lines through it; what it says of a cell
/// does not depend on the others. Cost: O(cells x literals).
std::vector<CellDepth> find_thin_cells(const Tree& tree, const Arrangement& arrangement,
                                       std::span<const std::size_t> cells, double depth,
                                       const RunContext& run);

}  // namespace hewn
