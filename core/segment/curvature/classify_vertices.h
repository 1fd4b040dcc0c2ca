#pragma once
/// Stage 1: tensor voting finds faces, ridges and corners.
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/segment/curvature/curvature_options.h"
#include "core/segment/triangle_topology.h"

namespace hewn {

enum class VertexClass : std::uint8_t { Face, Ridge, Corner };

/// The class of every vertex by the eigenvalues of its normals' tensor (Stroeter et al. 2026,
/// "Curvature classification"; thresholds of Jiao 2006). A vertex without triangles is a face.
/// Fails with: Cancelled. Cost: O(n). Same result for any thread count.
Result<std::vector<VertexClass>> classify_vertices(const Mesh& mesh,
                                                   const TriangleTopology& topology,
                                                   const CurvatureOptions& options,
                                                   const RunContext& run);

/// The angle of a triangle at one of its corners, in radians.
double corner_angle(const Mesh& mesh, int triangle, int k);

}  // namespace hewn
