#pragma once
/// Cuts a patch to the part of it that bounds the tree's solid.
#include <vector>

#include "core/csg/boundary/boundary_model.h"
#include "core/csg/tree_boundary.h"

namespace hewn {

/// The visible part of one patch.
struct PatchPart {
  std::vector<BoundaryCorner> corners;
  std::vector<BoundaryLine> lines;
  double area = 0;
  std::vector<int> flush;  ///< literals some face of which coincides with this patch, or adjoins it
};

/// Halves the patch where other literals' surfaces cross it, down to cells of the finest size, and
/// finds the edges in the last cells by bisection.
PatchPart cut_patch(const BoundaryModel& model, const BoundaryPatch& patch);

}  // namespace hewn
