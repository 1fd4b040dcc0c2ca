#pragma once
/// The repairs and checks that `repair_mesh` runs in turn. Internal to core/mesh.
/// `sides` are always the `sorted_sides` of the triangles beside them.
#include <span>
#include <vector>

#include "core/mesh/edge_use.h"
#include "core/mesh/load.h"

namespace hewn {

/// Vertices and triangles under repair. Indices are always in range.
struct Soup {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  double diagonal = 0;
};

/// Drops vertices that no triangle uses; the others keep their order.
void drop_unused_vertices(Soup& soup);

/// Joins vertices closer than `tolerance` (the one with the lowest index stays) and drops unused
/// ones; returns how many coinciding ones went. Cost: O(n).
int weld_vertices(Soup& soup, double tolerance);

/// Removes zero-area triangles without opening the surface: one whose corners lie in a row is
/// replaced by splitting its neighbour across the longest side.
/// Triangles lower than `tolerance` count as zero-area. Returns the number removed.
int remove_zero_area(Soup& soup, double tolerance);

/// Removes copies of the same triangle; two that face each other (a sheet of no thickness inside
/// the solid) both go. Of a part that is there twice as a whole, in the same or the opposite
/// orientation, one copy stays. Returns the number removed.
int remove_duplicates(Soup& soup, std::span<const EdgeSide> sides);

/// Turns triangles to agree with their neighbours, closed components outward, and closed
/// components that lie inside others (cavities) inward. Fills the report's counts and warnings.
/// True when a triangle was turned: its sides are others now. Fails with: Cancelled.
Result<bool> orient_triangles(Soup& soup, std::span<const EdgeSide> sides, MeshReport& report,
                              const RunContext& run);

/// Counts components, boundary edges, holes, non-manifold edges; writes the warnings.
void check_topology(const Soup& soup, std::span<const EdgeSide> sides, MeshReport& report);

/// Pairs of triangles that cross each other, up to `limit`; on big meshes a fixed sample of the
/// edges is tried. Fails with: Cancelled.
Result<int> count_self_intersections(const Mesh& mesh, std::span<const EdgeSide> sides, int limit,
                                     const RunContext& run);

/// See MeshReport::noise.
double estimate_noise(const Mesh& mesh, std::span<const EdgeSide> sides);

}  // namespace hewn
