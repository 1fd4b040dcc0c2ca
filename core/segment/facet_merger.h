#pragma once
/// Which triangles lie in one plane with their neighbours.
#include <array>
#include <vector>

#include "core/base/run_context.h"
#include "core/fit/face_groups.h"
#include "core/mesh/mesh.h"

namespace hewn {

/// Lengths, in model units, that decide which triangles lie in one plane.
struct FacetTolerance {
  double plane = 0;  ///< largest distance of a vertex from the facet's plane
  double noise = 0;  ///< standard deviation of a vertex about its true plane
};

struct MergedFacets {
  std::vector<Facet> facets;  ///< the one with the largest triangle first
  std::vector<int> facet_of_triangle;
};

/// Grows facets over coplanar neighbours, from the largest triangles on. What does not depend on
/// the tolerance is found once. Thread-safe; the mesh and its neighbours must outlive it.
class FacetMerger {
 public:
  /// `neighbors`: those of `triangle_neighbors(mesh)`. Cost: O(n log n).
  FacetMerger(const Mesh& mesh, const std::vector<std::array<int, 3>>& neighbors,
              const RunContext& run = {});

  /// Cost: O(n). Incomplete when cancelled.
  MergedFacets merge(const FacetTolerance& tolerance, const RunContext& run = {}) const;

  const Mesh& mesh() const { return mesh_; }
  const std::vector<std::array<int, 3>>& neighbors() const { return neighbors_; }

 private:
  class Growth;

  const Mesh& mesh_;
  const std::vector<std::array<int, 3>>& neighbors_;
  std::vector<double> height_;  ///< of each triangle, across its longest side
  std::vector<int> order_;      ///< triangles, the largest first, then in their own order
};

}  // namespace hewn
