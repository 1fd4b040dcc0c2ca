#pragma once
/// How much two meshes differ: distances both ways and the share of common volume.
#include <cstdint>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/mesh/query.h"

namespace hewn {

struct CompareOptions {
  int surface_samples = 100'000;  ///< per direction, beside all vertices
  int volume_samples = 200'000;   ///< uniform in the common bounding box
};

/// Distances from points of one surface to the other surface.
struct OneSidedDistance {
  double max = 0;   ///< one-sided Hausdorff distance
  double mean = 0;  ///< over the surface's area (vertices do not count)
  double p999 = 0;  ///< 99.9 % of the surface is nearer than this
};

/// Distances are shares of the first mesh's bounding-box diagonal.
struct MeshDifference {
  OneSidedDistance a_to_b, b_to_a;
  double hausdorff = 0;  ///< the greater of both maxima
  double mean = 0;       ///< of both means
  double p999 = 0;       ///< the greater of both
  double iou = 0;        ///< common over joint volume; 1 when no sample is in either
};

/// Compares two meshes on random points that depend on `run.seed` alone.
/// Fails with: Cancelled, BadMesh (a mesh without area).
/// Cost: one closest-point query a surface sample, two inside tests a volume sample, in parallel;
/// the same bits for any thread count.
Result<MeshDifference> compare_meshes(const MeshQuery& a, const MeshQuery& b,
                                      const CompareOptions& options, const RunContext& run);

}  // namespace hewn
