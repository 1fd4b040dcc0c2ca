#pragma once
/// Remeshing into small triangles of nearly equal sides.
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/mesh/mesh.h"

namespace hewn {

struct RemeshOptions {
  /// Wanted edge length as a share of the bounding box's diagonal.
  double edge_length = 1.0 / 60;
  /// The edges are made shorter until about this many times the input's triangles come out.
  double min_growth = 3;
  /// Upper limit of the wanted number of triangles; wins over `min_growth`.
  double max_triangles = 200'000;
  double feature_angle_deg = 24;  ///< sharper edges stay where they are
  int iterations = 8;
};

/// Botsch & Kobbelt, "A remeshing approach to multiresolution modeling" (SGP 2004), section 4:
/// split long edges, collapse short ones, flip towards valence 6, relax within the surface. All
/// vertices lie on the input's facets, sharp edges and corners are kept. Requires: a mesh as
/// `load_mesh` gives it. Fails with: BadMesh (not manifold), Cancelled.
Result<Mesh> remesh_isotropic(const Mesh& mesh, const RemeshOptions& options,
                              const RunContext& run);

}  // namespace hewn
