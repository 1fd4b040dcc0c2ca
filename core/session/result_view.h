#pragma once
/// What a window shows of a result: its surface as triangles, which literal made them, and how far
/// the input is from it.
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree_program.h"
#include "core/session/display_mesh.h"
#include "core/session/reconstruct.h"

namespace hewn {

struct ResultView {
  /// The tree's surface, labelled by literal.
  DisplayMesh surface;
  /// The tree for drawing ray by ray; null when it cannot be said so.
  std::shared_ptr<const TreeProgram> program;
  std::string program_problem;  ///< why `program` is null; else empty
  /// The input's triangles, corner by corner, labelled by the literal that explains them; `value`
  /// is the signed distance from the tree's surface, positive outside, in model units.
  DisplayMesh input;
  double max_deviation = 0;  ///< of the input's corners, model units
};

/// Fails with: Cancelled.
Result<ResultView> build_result_view(const Reconstruction& found, const RunContext& run,
                                     BoundaryDetail detail = BoundaryDetail::Fine);

}  // namespace hewn
