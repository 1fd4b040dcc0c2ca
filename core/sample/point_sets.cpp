#include "core/sample/point_sets.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/compute/parallel.h"
#include "core/sample/octant.h"

namespace hewn {
namespace {

constexpr std::size_t kMostPoints = 400'000;

/// A box with the literals whose surfaces may pass through it.
struct OctreeCell {
  Box3 box;
  std::vector<int> open;
};

OctreeCell cell_of(const Arrangement& arrangement, const Box3& box, const std::vector<int>& near) {
  OctreeCell cell{box, {}};
  const double reach = box.diagonal() / 2;
  for (const int k : near) {
    const double d =
        distance_within(arrangement.literals[k], arrangement.bounds[k], box.center(), reach);
    if (std::abs(d) <= reach) cell.open.push_back(k);
  }
  return cell;
}

/// Level by level, so that a tree cut short is equally fine everywhere.
std::vector<Vec3> centers_below(const Arrangement& arrangement, const Box3& root, double smallest,
                                std::size_t most, const RunContext& run) {
  std::vector<int> all(arrangement.literals.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
  std::vector<Vec3> centers;
  std::vector<OctreeCell> level{cell_of(arrangement, root, all)};
  while (!level.empty() && !run.is_cancelled()) {
    std::vector<OctreeCell> next;
    for (const OctreeCell& cell : level) {
      if (centers.size() >= most) return centers;
      centers.push_back(cell.box.center());
      if (cell.open.empty() || cell.box.size().maxCoeff() <= smallest) continue;
      for (int k = 0; k < 8; ++k) {
        next.push_back(cell_of(arrangement, octant_of(cell.box, k), cell.open));
      }
    }
    level = std::move(next);
  }
  return centers;
}

}  // namespace

std::vector<Vec3> octree_points(const Arrangement& arrangement, double smallest,
                                const RunContext& run) {
  std::vector<Box3> roots{common_box(arrangement)};
  for (const LiteralBounds& b : arrangement.bounds) roots.push_back(b.box);
  std::erase_if(roots, [](const Box3& box) { return !(box.diagonal() > 0); });
  std::vector<std::vector<Vec3>> found(roots.size());
  for_each_index(run.threads, roots.size(), [&](std::size_t i) {
    found[i] = centers_below(arrangement, roots[i], smallest, kMostPoints / roots.size(), run);
  });
  std::vector<Vec3> points;
  for (const auto& centers : found) points.insert(points.end(), centers.begin(), centers.end());
  return points;
}

std::vector<Vec3> grid_points(const Arrangement& arrangement, double step) {
  const Box3 box = common_box(arrangement);
  std::vector<Vec3> points;
  for (const LiteralBounds& b : arrangement.bounds) {
    if (!b.box.is_empty()) points.push_back(b.box.center());
  }
  if (box.is_empty()) return points;
  const double finest = std::cbrt(box.size().prod() / static_cast<double>(kMostPoints));
  const double side = std::max(step, finest);
  Vec3 at;
  for (at.z() = box.lo.z() - side / 2; at.z() < box.hi.z() + side; at.z() += side) {
    for (at.y() = box.lo.y() - side / 2; at.y() < box.hi.y() + side; at.y() += side) {
      for (at.x() = box.lo.x() - side / 2; at.x() < box.hi.x() + side; at.x() += side) {
        points.push_back(at);
      }
    }
  }
  return points;
}

Result<std::size_t> sample_cells(ArrangementSampler& sampler, CellSampling sampling,
                                 const ArrangementOptions& lines, const RunContext& run) {
  constexpr double kStep = 1.0 / 64;  // share of the scale
  if (sampling == CellSampling::Lines) return sampler.sample(lines, run);
  const Arrangement& a = sampler.arrangement();
  const double step = kStep * a.scale;
  const std::size_t added = sampler.add(
      sampling == CellSampling::Octree ? octree_points(a, step, run) : grid_points(a, step), run);
  if (run.is_cancelled()) return RunContext::cancelled();
  return added;
}

}  // namespace hewn
