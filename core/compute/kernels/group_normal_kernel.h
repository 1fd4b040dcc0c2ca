#pragma once
/// Normals at vertices, one for each tentative face group that meets there.
#include "core/compute/kernels/mesh_form.h"

namespace hewn {

/// Sums triangle normals around each vertex, separated by the marked sides (Stroeter et al. 2026,
/// equation 2.3). One item is one vertex. Cost: O(corners).
struct GroupNormalKernel : MeshKernel {
  const bool* is_marked = nullptr;  ///< by corner number: the side that begins there
  bool weights_are_angles = false;  ///< else areas
  PlainVec* normals = nullptr;      ///< out, by corner number
  int* sectors = nullptr;  ///< out, by corner number: the lowest of the same group; -1 at first

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const int vertex = number_of(item);
    const int* const begin = mesh.corners + mesh.first_corner[vertex];
    const int* const end = mesh.corners + mesh.first_corner[vertex + 1];
    for (const int* c = begin; c != end; ++c) {
      if (sectors[*c] < 0) name_sector(*c);
    }
    // The sums gather at each sector's first corner, which comes before its others.
    for (const int* c = begin; c != end; ++c) {
      const double weight = weights_are_angles ? mesh.corner_angle(*c) : mesh.areas[*c / 3];
      const PlainVec share = mesh.normals[*c / 3] * weight;
      PlainVec& sum = normals[sectors[*c]];
      sum = sectors[*c] == *c ? share : sum + share;
    }
    for (const int* c = begin; c != end; ++c) {
      if (sectors[*c] == *c) normals[*c] = direction_of(normals[*c]);
    }
    for (const int* c = begin; c != end; ++c) {
      const PlainVec shared = normals[sectors[*c]];
      normals[*c] = dot(shared, shared) > 0 ? shared : mesh.normals[*c / 3];
    }
  }

 private:
  /// Walks around the vertex from its corner `first`, both ways, up to marked sides.
  HEWN_HD void name_sector(int first) const {
    sectors[first] = first;
    const int vertex = mesh.triangles[first];
    for (int way = 0; way < 2; ++way) {
      int corner = first;
      int side = way == 0 ? first : MeshForm::side_before(first);
      while (!is_marked[side]) {
        const int next = corner_at(mesh.neighbors[side], vertex);
        if (next < 0 || sectors[next] >= 0) break;
        sectors[next] = first;
        // Leave by the side that was not crossed.
        const bool came_over_own = mesh.neighbors[next] == corner / 3;
        side = came_over_own ? MeshForm::side_before(next) : next;
        corner = next;
      }
    }
  }
  HEWN_HD int corner_at(int triangle, int vertex) const {
    if (triangle < 0) return -1;
    for (int corner = 3 * triangle; corner < 3 * triangle + 3; ++corner) {
      if (mesh.triangles[corner] == vertex) return corner;
    }
    return -1;
  }
  static HEWN_HD PlainVec direction_of(const PlainVec& v) {
    const double l = length(v);
    return l > 0 ? PlainVec{v.x / l, v.y / l, v.z / l} : PlainVec{};
  }
};

}  // namespace hewn
