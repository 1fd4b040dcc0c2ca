#pragma once
/// Flat patches of several literals that make one face.
#include <vector>

#include "core/csg/boundary/patch_cutter.h"

namespace hewn {

/// As part of which literal each patch is shown: its own, or where flat patches of several literals
/// are flush, the one with the largest area. `parts`: one for each of the model's patches.
std::vector<int> shown_literals(const BoundaryModel& model, const std::vector<PatchPart>& parts);

}  // namespace hewn
