#pragma once
/// What segmentation by curvature knows of a mesh before it looks for primitives: classes of
/// vertices, tentative boundaries, normals, curvatures, classes of triangles, flooded regions
/// (Stroeter et al. 2026, "Curvature classification" and "Simple region growing").
#include <array>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/compute/kernels/curvature_kernels.h"
#include "core/compute/kernels/vertex_class_kernel.h"
#include "core/segment/curvature/curvature_options.h"
#include "core/segment/triangle_topology.h"

namespace hewn {

struct Boundaries {
  /// Whether each side of each triangle is marked; both triangles of an edge agree.
  std::vector<std::array<bool, 3>> is_marked;
  /// The paper's k^FG: tentative number of face groups that meet at each vertex, at least 1.
  std::vector<int> group_count;
};

struct GroupNormals {
  /// Unit normal at each corner (3 t + k): that of the corner's group at the vertex.
  std::vector<Vec3> normal_of_corner;
  /// The lowest corner number of the same group at the same vertex.
  std::vector<int> sector_of_corner;
};

/// Curvatures are in 1 / model units, positive where the solid is convex.
struct PrincipalCurvatures {
  double max = 0;                      ///< kappa_max: the one of larger magnitude
  double min = 0;                      ///< kappa_min: the one of smaller magnitude
  Vec3 max_direction = Vec3::UnitX();  ///< unit tangent along which `max` is measured

  double mean() const { return (max + min) / 2; }
};

/// Refers to its mesh, owns the rest.
struct CurvatureStages {
  const Mesh& mesh;
  TriangleTopology topology;
  std::vector<VertexClass> vertices;  ///< one without triangles is a face
  Boundaries boundaries;
  GroupNormals normals;
  std::vector<PrincipalCurvatures> curvatures;
  std::vector<CurvatureClass> classes;  ///< of triangles
  /// The lowest triangle index of each triangle's region: those of the same class that are reached
  /// without crossing a marked edge; -1 for triangles without area. Only with
  /// `RegionGrowth::Flood`. The paper spreads the largest index; the regions are the same.
  std::vector<int> labels;
};

enum class KeptStages { WhatFollows, All };

/// Runs all stages on `compute_of(run)`. `WhatFollows` leaves `vertices`, `boundaries.group_count`
/// and `normals` empty, which no later step looks at.
/// Fails with: Cancelled. Cost: O(n log n) for the topology, O(n) for the rest. Same bits for any
/// thread count and on every device.
Result<CurvatureStages> compute_stages(const Mesh& mesh, const CurvatureOptions& options,
                                       const RunContext& run,
                                       KeptStages kept = KeptStages::WhatFollows);

/// The thresholds for a mesh with this bounding box's diagonal.
CurvatureLimits curvature_limits(double diagonal, const CurvatureOptions& options);

}  // namespace hewn
