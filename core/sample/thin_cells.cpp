#include "core/sample/thin_cells.h"

#include <algorithm>
#include <cmath>

#include "core/base/rng.h"
#include "core/compute/parallel.h"
#include "core/csg/tree_ray.h"
#include "core/sample/equivalence.h"
#include "core/sample/near_middle.h"

namespace hewn {
namespace {

constexpr int kHops = 2;

/// Moves a point towards the middle of its cell along a random line. `stretches` is scratch memory.
Vec3 hop(const TreeRays& literals, const Vec3& p, double scale, Rng& rng,
         std::vector<TreeInterval>& stretches) {
  Vec3 d;
  for (int k = 0; k < 3; ++k) d[k] = rng.uniform(-1, 1);
  if (d.squaredNorm() < 1e-6) return p;
  d.normalize();
  const double reach = 2 * scale;
  double before = 0;
  double after = 2 * reach;
  literals.cast_literals(p - reach * d, d, stretches);
  for (const TreeInterval& s : stretches) {
    for (const double t : {s.enter.t, s.leave.t}) {
      if (t <= reach) before = std::max(before, t);
      if (t > reach) after = std::min(after, t);
    }
  }
  return p + (near_middle(before, after) - reach) * d;
}

}  // namespace

std::vector<CellDepth> find_thin_cells(const Tree& tree, const Arrangement& arrangement,
                                       std::span<const std::size_t> cells, double depth,
                                       const RunContext& run) {
  std::vector<CellDepth> depths(cells.size());
  const TreeRays rays(tree);
  Tree all;
  all.literals = arrangement.literals;
  const TreeRays literals(all);
  for_each_chunk(run.threads, depths.size(), 16, [&](std::size_t begin, std::size_t end) {
    TreeRayScratch scratch;
    std::vector<TreeInterval> stretches;
    const auto is_deep = [&](const Vec3& p) {
      return distance_along_rays(rays, p, depth, scratch) > depth;
    };
    for (std::size_t i = begin; i < end && !run.is_cancelled(); ++i) {
      Rng rng(run.seed, cells[i]);
      Vec3 p = arrangement.points[cells[i]];
      bool found_deep = is_deep(p);
      for (int k = 0; k < kHops && !found_deep; ++k) {
        p = hop(literals, p, arrangement.scale, rng, stretches);
        found_deep = is_deep(p);
      }
      depths[i] = {!found_deep, p};
    }
  });
  return depths;
}

}  // namespace hewn
