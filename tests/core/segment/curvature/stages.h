#pragma once
/// All stages of segmentation by curvature, for tests of each.
#include "core/segment/curvature/stages.h"

namespace hewn {

/// Requires: `mesh` outlives the result where a test goes on with its regions.
inline CurvatureStages run_stages(const Mesh& mesh, CurvatureOptions options = {},
                                  int threads = 1) {
  RunContext run;
  run.threads = threads;
  options.growth = static_cast<int>(RegionGrowth::Flood);
  return *compute_stages(mesh, options, run, KeptStages::All);
}

/// Triangles whose three corners all have a height strictly between the two.
inline std::vector<int> triangles_between(const Mesh& mesh, double z0, double z1) {
  std::vector<int> found;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    bool is_between = true;
    for (int k = 0; k < 3; ++k) {
      const double z = mesh.corner(t, k).z();
      is_between = is_between && z > z0 && z < z1;
    }
    if (is_between) found.push_back(t);
  }
  return found;
}

}  // namespace hewn
