#pragma once
/// Runs the stages of segmentation by curvature one after the other, for tests of each.
#include "core/segment/curvature/flood_regions.h"

namespace hewn {

struct Stages {
  TriangleTopology topology;
  std::vector<VertexClass> vertices;
  Boundaries boundaries;
  GroupNormals normals;
  std::vector<PrincipalCurvatures> curvatures;
  std::vector<CurvatureClass> triangles;
  std::vector<int> labels;
};

inline Stages run_stages(const Mesh& mesh, const CurvatureOptions& options = {}, int threads = 1) {
  RunContext run;
  run.threads = threads;
  Stages s;
  s.topology = build_topology(mesh);
  s.vertices = *classify_vertices(mesh, s.topology, options, run);
  s.boundaries = find_boundaries(mesh, s.topology, s.vertices, options);
  s.normals = *compute_group_normals(mesh, s.topology, s.boundaries, options, run);
  s.curvatures = *compute_principal_curvatures(mesh, s.topology, s.normals, run);
  s.triangles = classify_triangles(mesh, s.curvatures, options);
  s.labels = *flood_regions(s.topology, s.boundaries, s.triangles, run);
  return s;
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
