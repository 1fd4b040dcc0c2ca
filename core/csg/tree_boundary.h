#pragma once
/// The boundary of a tree's solid as triangles for pictures: the patches of its literals, cut where
/// they leave the boundary. Fast, and not watertight; `tessellate` makes files.
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"

namespace hewn {

struct BoundaryCorner {
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit, out of the solid; of the true surface, not the facet
  std::int32_t label = 0;       ///< the literal that it is shown as part of
};

/// A piece of an edge: faces of two literals meet, or two of one.
struct BoundaryLine {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  std::int32_t label = 0;
};

struct TreeBoundary {
  std::vector<BoundaryCorner> corners;  ///< three a triangle, counter-clockwise from outside
  std::vector<BoundaryLine> lines;
  /// As which literal each flat end is shown, six a literal (by axis, the lower end first): where
  /// ends of several literals are flush, as the one with the largest area.
  std::vector<std::int32_t> shown;
};

/// Pieces with a corner in them are smaller than 1/150, or 1/50, of the diagonal.
enum class BoundaryDetail { Fine, Rough };

/// `diagonal`: of the model, for what is near and what is small: edges are found to 1e-5 of it.
/// Fails with: Cancelled. Cost: O(length of all edges x literals near them). Deterministic.
Result<TreeBoundary> tree_boundary(const Tree& tree, double diagonal, const RunContext& run,
                                   BoundaryDetail detail = BoundaryDetail::Fine);

}  // namespace hewn
