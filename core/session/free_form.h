#pragma once
/// Parts of which some patch is free-form: primitives for all else, the mesh itself there.
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fit/surface_set.h"
#include "core/session/plan.h"
#include "core/synth/find_tree.h"

namespace hewn {

/// Small face groups that hang together and that no primitive explains.
struct FreeFormPatch {
  std::vector<int> groups;  ///< ascending
  int unfitted = 0;         ///< of them without a surface of their own
};

/// Patches of many faces, the first found first. Cost: O(triangles).
std::vector<FreeFormPatch> find_free_form_patches(const Mesh& mesh,
                                                  const Segmentation& segmentation);

/// A tree with the mesh in its place in a box around each patch.
struct FreeFormAnswer {
  TreeAnswer answer;
  double area_share = 0;  ///< of the patches, of the mesh's surface
};

/// Searches a tree for what lies outside a box around each patch; within the boxes the mesh itself,
/// one polyhedron literal cut to the boxes, is the solid.
/// Fails with: NotFound (no patch, patches that reach over most of the part, no tree for the
/// rest), Cancelled. Requires: a closed mesh.
Result<FreeFormAnswer> find_tree_beside(const std::vector<FreeFormPatch>& patches,
                                        const PreparedMesh& prepared,
                                        const RegulariseOptions& regularise_options,
                                        const TreeSearchOptions& tree_options,
                                        const RunContext& run);

}  // namespace hewn
