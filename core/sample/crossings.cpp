#include "core/sample/crossings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/sample/arrangement_lines.h"

namespace hewn {
namespace {

/// Pairs of planes looked at for each whose common line meets both literals.
constexpr std::size_t kTriesPerCrossing = 8;

using Pair = std::pair<std::size_t, std::size_t>;

/// Pairs of literals that may cut each other.
std::vector<Pair> neighbours_of(const Arrangement& arrangement, std::size_t first,
                                std::size_t end) {
  std::vector<Pair> pairs;
  const Vec3 margin = Vec3::Constant(2 * arrangement.resolution);
  for (std::size_t b = first; b < end; ++b) {
    const Vec3 lo = arrangement.bounds[b].box.lo - margin;
    const Vec3 hi = arrangement.bounds[b].box.hi + margin;
    for (std::size_t a = 0; a < b; ++a) {
      const Box3& other = arrangement.bounds[a].box;
      if ((other.lo.array() > hi.array()).any() || (other.hi.array() < lo.array()).any()) continue;
      pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

bool line_meets(const Box3& box, double margin, const Vec3& point, const Vec3& direction) {
  double enter = -kInfinity;
  double leave = kInfinity;
  for (int k = 0; k < 3; ++k) {
    const double a = (box.lo[k] - margin - point[k]) / direction[k];
    const double b = (box.hi[k] + margin - point[k]) / direction[k];
    if (std::isnan(a) || std::isnan(b)) continue;  // within a side's plane
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

/// Nothing when the planes are parallel or their line passes one of the literals by.
std::optional<Crossing> crossing_of(const Arrangement& arrangement, Pair literals,
                                    const FacePlane& p, const FacePlane& q) {
  const Crossing crossing{p.normal, q.normal, p.normal.dot(p.point), q.normal.dot(q.point),
                          p.normal.cross(q.normal)};
  if (crossing.along.squaredNorm() < 1e-10) return std::nullopt;
  const Vec3 point = crossing.point(0, 0);
  const double margin = 2 * arrangement.resolution;
  for (const std::size_t k : {literals.first, literals.second}) {
    if (!line_meets(arrangement.bounds[k].box, margin, point, crossing.along)) return std::nullopt;
  }
  return crossing;
}

}  // namespace

Vec3 Crossing::point(double beyond_p, double beyond_q) const {
  return ((offset_p + beyond_p) * normal_q.cross(along) +
          (offset_q + beyond_q) * along.cross(normal_p)) /
         along.squaredNorm();
}

Crossings find_crossings(const Arrangement& arrangement, std::size_t first, std::size_t end,
                         std::size_t most, Rng rng) {
  std::vector<std::vector<FacePlane>> planes;
  for (const Literal& s : arrangement.literals) planes.push_back(planes_of(s));
  const std::vector<Pair> neighbours = neighbours_of(arrangement, first, end);
  std::size_t count = 0;
  for (const auto& [a, b] : neighbours) count += planes[a].size() * planes[b].size();
  Crossings out;
  const auto offer = [&](const Pair& pair, const FacePlane& p, const FacePlane& q) {
    if (const auto crossing = crossing_of(arrangement, pair, p, q)) out.found.push_back(*crossing);
  };
  if (count <= kTriesPerCrossing * most) {
    for (const Pair& pair : neighbours) {
      for (const FacePlane& p : planes[pair.first]) {
        for (const FacePlane& q : planes[pair.second]) offer(pair, p, q);
      }
    }
    out.are_all = out.found.size() <= most;
    if (out.are_all) return out;
    out.found.clear();
  }
  for (std::size_t i = 0; i < kTriesPerCrossing * most && out.found.size() < most; ++i) {
    const Pair& pair = neighbours[rng.below(neighbours.size())];
    const auto& of_a = planes[pair.first];
    const auto& of_b = planes[pair.second];
    if (of_a.empty() || of_b.empty()) continue;
    const FacePlane& p = of_a[rng.below(of_a.size())];
    const FacePlane& q = of_b[rng.below(of_b.size())];
    offer(pair, p, q);
  }
  return out;
}

}  // namespace hewn
