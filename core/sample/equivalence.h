#pragma once
/// Whether two trees describe the same solid: proved cell by cell where distances allow it, tested
/// on fresh points everywhere.
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"
#include "core/csg/tree_ray.h"

namespace hewn {

struct EquivalenceOptions {
  std::size_t points = 50'000;       ///< fresh random points in the box of all literals
  double smallest_cell = 1.0 / 64;   ///< of the octree, share of the scale
  double scale = 0;                  ///< the solid's diagonal; 0: taken from the box of `a`
  std::size_t most_cells = 200'000;  ///< of the octree; what is then not proved is left to points
  int points_per_open_cell = 4;      ///< in smallest cells that are not proved
  std::uint64_t stream = 1;          ///< another one draws other points
  /// Points that differ but lie this near to the surface of `a` are tolerated (model units).
  double allowed_distance = 0;
};

struct Equivalence {
  double proved_share = 0;  ///< of the box's volume, where no point can differ
  std::size_t proved_cells = 0;
  std::size_t open_cells = 0;  ///< smallest cells left to points
  std::size_t points = 0;      ///< compared, without those too near to a surface to tell
  std::size_t different = 0;   ///< of them, inside one solid only and not tolerated
  std::size_t tolerated = 0;   ///< of them, inside one solid only and near enough to the surface
  /// How far points inside one solid only are from the surface of `a`, at most; in model units,
  /// along rays, of at most 2000 of them.
  double largest_distance = 0;
  std::vector<Vec3> examples;  ///< points that count as different, at most 1000
  double smallest_cell = 0;    ///< longest edge, in model units

  bool is_same() const { return different == 0; }
};

/// Compares the solids. A cell of the octree is proved when the two formulas agree for every
/// combination of those literals whose surfaces may pass through it.
/// Fails with: Cancelled. Same result for any number of threads.
/// Cost: O(surface cells x literals there).
Result<Equivalence> compare_trees(const Tree& a, const Tree& b, const EquivalenceOptions& options,
                                  const RunContext& run);

/// An upper bound on the distance from `p` to the tree's surface: the shortest of 26 rays; infinite
/// when none meets it. Stops at the first one not longer than `enough`; unless that is 0, what it
/// returns beyond it only says that there is none.
double distance_along_rays(const TreeRays& rays, const Vec3& p, double enough,
                           TreeRayScratch& scratch);

}  // namespace hewn
