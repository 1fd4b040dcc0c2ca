#pragma once
/// Cuts chosen face groups along a plane (Stroeter et al. 2026: "Users may bisect selected FGs
/// along a cut plane to refine the segmentation").
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fit/face_groups.h"
#include "core/mesh/mesh.h"
#include "core/segment/edit/edited_segmentation.h"

namespace hewn {

/// The plane `normal . x = offset`; `normal` is a unit vector.
struct CutPlane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0;
};

struct BisectOptions {
  /// Vertices closer to the plane than this share of the bounding box's diagonal count as on it,
  /// so that the cut runs through them instead of leaving slivers beside them. None is moved.
  double snap = 1e-6;
};

/// Splits the triangles of `groups` exactly where the plane passes through them. Neighbours in
/// other groups share the new vertices, so that a closed mesh stays closed, but stay one group.
///
/// A group with triangles on both sides keeps its index for the part that `normal` points to; the
/// other part is appended, in the order of the groups' indices. Surfaces are kept, not refitted.
/// New vertices are appended after the old ones.
/// Fails with: InvalidArgument (no such group, normal not of unit length), Cancelled.
/// Cost: O(n log n).
Result<EditedSegmentation> bisect_groups(const Mesh& mesh, const Segmentation& segmentation,
                                         std::span<const int> groups, const CutPlane& plane,
                                         const BisectOptions& options, const RunContext& run);

}  // namespace hewn
