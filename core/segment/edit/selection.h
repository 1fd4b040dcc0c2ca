#pragma once
/// Growing, shrinking and completing selections of triangles and face groups. Selections are
/// ascending lists of indices without repetitions, and so are the results.
#include <span>
#include <vector>

#include "core/fit/face_groups.h"
#include "core/segment/triangle_topology.h"

namespace hewn {

/// For each group, the groups that share an edge with it, ascending. Cost: O(n log n).
std::vector<std::vector<int>> group_neighbors(const Segmentation& segmentation,
                                              const TriangleTopology& topology);

/// Adds `steps` rings of triangles across edges.
std::vector<int> grow_triangles(const TriangleTopology& topology, std::span<const int> selected,
                                int steps = 1);

/// Takes away, `steps` times, the triangles with an unselected neighbour; a rim of the mesh itself
/// does not count as one.
std::vector<int> shrink_triangles(const TriangleTopology& topology, std::span<const int> selected,
                                  int steps = 1);

/// Adds the groups that share an edge with a selected one, `steps` times.
std::vector<int> grow_groups(const std::vector<std::vector<int>>& neighbors,
                             std::span<const int> selected, int steps = 1);

/// Takes away the groups that share an edge with an unselected one, `steps` times.
std::vector<int> shrink_groups(const std::vector<std::vector<int>>& neighbors,
                               std::span<const int> selected, int steps = 1);

/// What a group must have in common with the example; all that are set must hold.
struct Similarity {
  bool same_kind = true;     ///< and the same side: bosses are not holes
  bool parallel = false;     ///< axes or normals, up to sign; never holds for a sphere
  bool coaxial = false;      ///< also spheres centred on the axis, planes across it
  bool same_radius = false;  ///< all radii or the cone's angle; holds for two planes
  double angle_rad = 1e-3;   ///< tolerance of directions and cone angles
  double length = 0;         ///< tolerance of positions and radii, model units
};

/// Groups similar to `example`, itself included. Requires: a valid index.
std::vector<int> select_similar(const Segmentation& segmentation, int example,
                                const Similarity& similarity);

}  // namespace hewn
