#include "core/synth/rebuild/boundary.h"

#include <algorithm>
#include <cmath>

#include "core/base/rng.h"
#include "core/compute/parallel.h"
#include "core/sample/equivalence.h"

namespace hewn {
namespace {

struct Line {
  Vec3 point, direction;
};

std::vector<Line> lines_through(const TreeRays& rays, const std::vector<Vec3>& points,
                                const BoundaryLines& wanted, const RunContext& run) {
  const Box3 box = rays.tree().bounds();
  Rng rng(run.seed, 0xB0DA);
  std::vector<Line> lines;
  const auto add = [&](const Vec3& p, std::size_t k) {
    Vec3 d = Vec3::Unit(static_cast<int>(k % 3));
    if (k % 4 == 3) {
      for (int c = 0; c < 3; ++c) d[c] = rng.uniform(-1, 1);
    }
    if (d.norm() > 1e-3) lines.push_back({p, d.normalized()});
  };
  const std::size_t random = std::min(
      wanted.most_random, wanted.least_random + wanted.per_literal * rays.tree().literals.size());
  for (std::size_t k = 0; k < random; ++k) {
    Vec3 p;
    for (int c = 0; c < 3; ++c) p[c] = rng.uniform(box.lo[c], box.hi[c]);
    add(p, k);
  }
  const std::size_t step = 1 + 4 * points.size() / wanted.through_points;
  for (std::size_t i = 0; i < points.size(); i += step) {
    for (std::size_t k = 0; k < 4; ++k) add(points[i], k);
  }
  return lines;
}

}  // namespace

std::vector<BoundaryHit> boundary_hits(const TreeRays& rays, const TreeSurfaces& surfaces,
                                       const std::vector<Vec3>& points, const BoundaryLines& wanted,
                                       const RunContext& run) {
  const std::vector<Line> lines = lines_through(rays, points, wanted, run);
  const Box3 box = rays.tree().bounds();
  std::vector<std::vector<BoundaryHit>> found(lines.size());
  for_each_chunk(run.threads, lines.size(), 64, [&](std::size_t begin, std::size_t end) {
    TreeRayScratch scratch;
    for (std::size_t i = begin; i < end && !run.is_cancelled(); ++i) {
      const Vec3& d = lines[i].direction;
      const double reach = 2 * box.diagonal() + (lines[i].point - box.center()).norm();
      const Vec3 from = lines[i].point - reach * d;
      for (const TreeInterval& s : rays.cast(from, d, scratch)) {
        for (const bool enters : {true, false}) {
          const TreeCrossing& c = enters ? s.enter : s.leave;
          if (!std::isfinite(c.t) || c.literal < 0) continue;
          const Vec3 p = from + c.t * d;
          const Vec3 normal = rays.normal(c, p, enters ? d : Vec3(-d));
          found[i].push_back({p, normal, surfaces.nearest(c.literal, p)});
        }
      }
    }
  });
  std::vector<std::size_t> count(surfaces.all.halfspaces.size(), 0);
  std::vector<BoundaryHit> hits;
  for (const auto& of_line : found) {
    for (const BoundaryHit& h : of_line) {
      if (h.halfspace < 0) continue;
      std::size_t& kept = count[static_cast<std::size_t>(h.halfspace)];
      if (kept >= wanted.most_hits) continue;
      ++kept;
      hits.push_back(h);
    }
  }
  return hits;
}

bool is_free(const TreeRays& rays, const Vec3& p, double depth) {
  TreeRayScratch scratch;
  return depth > 0 && distance_along_rays(rays, p, depth, scratch) <= depth;
}

}  // namespace hewn
