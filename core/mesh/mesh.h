#pragma once
/// The welded triangle mesh that every stage reads, and its edge adjacency.
#include <array>
#include <vector>

#include "core/base/math.h"

namespace hewn {

using Triangle = std::array<int, 3>;

/// An indexed triangle mesh with derived per-triangle values. Treat as immutable once made.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;  ///< counter-clockwise seen from outside
  std::vector<Vec3> normals;        ///< unit, one per triangle; zero for a zero-area triangle
  std::vector<double> areas;        ///< one per triangle
  Box3 bounds;
  double total_area = 0;
  double volume = 0;  ///< signed; positive when the orientation is outward

  double diagonal() const { return bounds.diagonal(); }
  Vec3 corner(int triangle, int k) const { return vertices[triangles[triangle][k]]; }
  Vec3 centroid(int triangle) const {
    return (corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2)) / 3;
  }
};

/// Computes the derived values. Requires: indices in range.
Mesh make_mesh(std::vector<Vec3> vertices, std::vector<Triangle> triangles);

/// An undirected edge with the triangles around it (two on a closed manifold).
struct Edge {
  int a = 0, b = 0;            ///< vertices, a < b
  std::vector<int> triangles;  ///< ascending
};

/// All edges, ordered by (a, b). Cost: O(n log n).
std::vector<Edge> build_edges(const Mesh& mesh);

}  // namespace hewn
