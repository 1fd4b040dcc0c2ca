#pragma once
/// Tentative boundaries between face groups.
#include "core/compute/kernels/vertex_class_kernel.h"

namespace hewn {

/// Marks a side whose vertices are both no face and whose triangles meet at more than the ridge
/// angle; also hole rims and non-manifold edges. One item is one triangle.
struct BoundaryKernel : MeshKernel {
  const VertexClass* classes = nullptr;  ///< of vertices
  double ridge_angle = 0;                ///< radians
  bool* is_marked = nullptr;             ///< out, by corner number: the side that begins there
  /// Out, by vertex, 0 at first: twice the number of marked edges, as an edge with two triangles
  /// is seen from both.
  int* marks = nullptr;

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const int t = number_of(item);
    for (int k = 0; k < 3; ++k) {
      const int corner = 3 * t + k;
      const int a = mesh.triangles[corner];
      const int b = mesh.triangles[3 * t + (k + 1) % 3];
      const int other = mesh.neighbors[corner];
      const bool is_rim = other < 0;
      const bool is_sharp = !is_rim && classes[a] != VertexClass::Face &&
                            classes[b] != VertexClass::Face &&
                            angle_between(mesh.normals[t], mesh.normals[other]) > ridge_angle;
      is_marked[corner] = is_rim || is_sharp;
      if (!is_marked[corner]) continue;
      add_to(marks + a, is_rim ? 2 : 1);
      add_to(marks + b, is_rim ? 2 : 1);
    }
  }
};

}  // namespace hewn
