#pragma once
/// A mesh as a renderer wants it: corners with their shading normals, each once, triangles over
/// them, and the lines where faces meet.
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/run_context.h"
#include "core/csg/tree_boundary.h"
#include "core/session/plan.h"

namespace hewn {

/// Single precision, relative to `DisplayMesh::origin`.
struct DisplayCorner {
  std::array<float, 3> position;
  std::array<float, 3> normal;  ///< unit
  std::int32_t label;           ///< face group or literal; -1: none
  float value;                  ///< e.g. a deviation; 0 at first
};

/// One end of a line; two make a line.
struct DisplayLineEnd {
  std::array<float, 3> position;
  std::array<std::int32_t, 2> labels;  ///< of the faces on both sides; equal inside one face
};

struct DisplayMesh {
  Vec3 origin = Vec3::Zero();
  Box3 bounds;                         ///< model coordinates
  std::vector<DisplayCorner> corners;  ///< all different
  std::vector<std::int32_t> vertices;  ///< of the mesh, for each corner
  std::vector<std::uint32_t> indices;  ///< of corners, three a triangle
  /// A rougher picture for slow renderers while the view moves; empty when `indices` are few.
  std::vector<std::uint32_t> coarse;
  std::vector<DisplayLineEnd> lines;
  int labels = 0;          ///< one more than the largest label
  bool is_closed = false;  ///< and oriented: no triangle is seen from behind
};

/// Meshes of more triangles than this get a coarse version of about half as many.
inline constexpr std::size_t kManyTriangles = 150000;

/// Corner normals are averaged over triangles of one label that meet at less than 40 degrees; lines
/// stand where labels change and at borders. `labels` holds one number a triangle. O(n log n).
DisplayMesh build_display_mesh(const Mesh& mesh, const std::vector<int>& labels);

/// Labelled by literal.
DisplayMesh build_display_mesh(const TreeBoundary& boundary);

/// Labelled by face group.
DisplayMesh build_display_mesh(const PreparedMesh& prepared);

/// How many of the groups have triangles on both sides of the plane. Cost: O(vertices).
int groups_crossed(const PreparedMesh& prepared, const std::vector<int>& groups, const Vec3& normal,
                   double offset);

}  // namespace hewn
