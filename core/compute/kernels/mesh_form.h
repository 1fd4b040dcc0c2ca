#pragma once
/// A mesh as kernels see it.
#include "core/compute/kernels/plain_vec.h"

namespace hewn {

/// Triangles, their derived values and their adjacency, in plain arrays (core/mesh/mesh.h and
/// core/segment/triangle_topology.h have the meaning of each). Corner k of triangle t has the
/// number 3 t + k; side k runs from corner k to the next.
struct MeshForm {
  const PlainVec* vertices = nullptr;
  const int* triangles = nullptr;  ///< three vertices each
  const PlainVec* normals = nullptr;
  const double* areas = nullptr;
  const int* neighbors = nullptr;     ///< across each side, -1 for none
  const int* corners = nullptr;       ///< grouped by vertex, ascending
  const int* first_corner = nullptr;  ///< of each vertex in `corners`, and the end
  std::int64_t vertex_count = 0;
  std::int64_t triangle_count = 0;

  HEWN_HD PlainVec position(int corner) const { return vertices[triangles[corner]]; }
  HEWN_HD double corner_angle(int corner) const {
    const int t = corner / 3;
    const int k = corner % 3;
    const PlainVec v = position(corner);
    return angle_between(position(3 * t + (k + 1) % 3) - v, position(3 * t + (k + 2) % 3) - v);
  }
};

/// The items of a kernel over a range of vertices or triangles.
struct ItemRange {
  std::int64_t begin = 0, end = 0;

  HEWN_HD std::int64_t size() const { return end - begin; }
};

}  // namespace hewn
