#pragma once
/// Writing a decision list down as a tree of bounded literals.
#include "core/csg/tree.h"
#include "core/fit/surface_set.h"
#include "core/mesh/mesh.h"
#include "core/sample/frame.h"
#include "core/synth/decompose/decision_list.h"

namespace hewn {

struct LoweringOptions {
  bool clip = false;     ///< intersect the whole with the frame's box
  bool is_tool = false;  ///< the solid will be subtracted: it sticks out where it is unbounded
  /// Tools end a little behind the end of their work (`Term::work_ends`) where that is safe, and
  /// what is taken out of a term a little outside of the rest of it.
  bool shortens_tools = false;
  int threads = 1;  ///< for shortening; 0: one per core
};

/// Lowers `list` to a tree. United primitives end at the geometry's extents where no literal bounds
/// them; subtracted ones stick out beyond it, so that no zero-thickness sheet can remain.
/// `triangles` restricts the extents; empty means the whole mesh.
Tree lower_list(const DecisionList& list, const SurfaceSet& surfaces, const Mesh& mesh,
                const std::vector<int>& triangles, const Frame& frame,
                const LoweringOptions& options);

}  // namespace hewn
