#pragma once
/// How well a tree reproduces a mesh, on fresh points that no search has seen.
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"
#include "core/mesh/query.h"
#include "core/session/settings.h"

namespace hewn {

/// Distances are shares of the mesh's bounding-box diagonal.
struct TreeScore {
  double agreement = 0;  ///< share of volume points in a box 5 % larger that are classified alike
  double iou = 0;        ///< intersection over union, wherever mesh or tree reach
  double hausdorff = 0;  ///< the larger of both ways' largest distances
  double mean_distance = 0;  ///< the larger of both ways' means
  double mesh_to_tree_max = 0;
  double tree_to_mesh_max = 0;
  double proximity = 1;         ///< design measure `P(T) / #|T|`
  double polyhedron_share = 0;  ///< share of the tree's surface on polyhedron literals
};

/// Distances from the mesh are measured by walking down the tree's distance field, those from the
/// tree at crossings of random lines with its surface (uniform by Cauchy and Crofton), and for the
/// largest one also of lines aimed at each literal.
/// Fails with: Cancelled. Same result for any thread count.
Result<TreeScore> score_tree(const MeshQuery& query, const Tree& tree,
                             const VerifySettings& settings, const RunContext& run);

/// How far `p` lies outside the tree's solid (inside: negative), in model units: the walk that
/// `score_tree` measures with. `diagonal` is the mesh's.
double signed_distance_to_tree(const Tree& tree, const Vec3& p, double diagonal);

}  // namespace hewn
