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

  /// The side that ends at a corner; the one that begins there has the corner's number.
  static HEWN_HD int side_before(int corner) { return corner / 3 * 3 + (corner % 3 + 2) % 3; }
  HEWN_HD PlainVec position(int corner) const { return vertices[triangles[corner]]; }
  HEWN_HD double corner_angle(int corner) const {
    const int t = corner / 3;
    const int k = corner % 3;
    const PlainVec v = position(corner);
    return angle_between(position(3 * t + (k + 1) % 3) - v, position(3 * t + (k + 2) % 3) - v);
  }
};

/// What kernels over a mesh have in common: each item is one triangle or one vertex of a range.
struct MeshKernel {
  MeshForm mesh;
  std::int64_t range_begin = 0, range_end = 0;  ///< triangles or vertices

  template <class Grain>
  HEWN_HD std::int64_t items() const {
    return range_end - range_begin;
  }

 protected:
  HEWN_HD int number_of(std::int64_t item) const { return static_cast<int>(range_begin + item); }
};

}  // namespace hewn
