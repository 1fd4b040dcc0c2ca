#include "core/synth/rebuild/bounding_surfaces.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hewn {
namespace {

/// By how many the points in the minority of their cell become fewer with the surface, four times,
/// and how many cells it divides at all: that may help the next one.
long gain_of(const Surface& surface, const SampleTable& table,
             const std::vector<std::vector<int>>& mixed) {
  long gain = 0;
  for (const std::vector<int>& points : mixed) {
    int count[2][2] = {{0, 0}, {0, 0}};  // by side of the surface and label
    for (const int i : points) {
      const auto k = static_cast<std::size_t>(i);
      ++count[surface.signed_distance(table.points[k]) < 0 ? 1 : 0][table.is_inside[k] ? 1 : 0];
    }
    const auto minority = [](const int(&c)[2]) { return std::min(c[0], c[1]); };
    const int all = std::min(count[0][0] + count[1][0], count[0][1] + count[1][1]);
    gain += 4L * (all - minority(count[0]) - minority(count[1]));
    if (count[0][0] + count[0][1] > 0 && count[1][0] + count[1][1] > 0) gain += 1;
  }
  return gain;
}

}  // namespace

bool BoundingSurfaces::find_all() {
  if (!has_looked_) {
    has_looked_ = true;
    const Tree& tree = solid_.rays.tree();
    auto known = tree.is_empty() || !std::isfinite(tree.bounds().diagonal())
                     ? std::nullopt
                     : surfaces_of(tree.literals, solid_.scale);
    if (known) known_ = std::move(*known);
  }
  return !all().empty();
}

bool BoundingSurfaces::find_bounding() {
  if (!find_all()) return false;
  if (!place_.empty()) return !used_.halfspaces.empty();
  place_.assign(all().size(), 0);
  const auto seen = boundary_hits(solid_.rays, known_, points_, kManyLines, run_);
  used_.directions = known_.all.directions;
  for (const BoundaryHit& hit : seen) {
    if (solid_.depth > 0 && !is_deep(hit)) continue;
    hits_.push_back(hit);
    use(static_cast<std::size_t>(hit.halfspace));
    used_.halfspaces[index_in_used(hit)].area += 1;
  }
  find_frame_of(seen);
  return !used_.halfspaces.empty();
}

std::vector<Halfspace> BoundingSurfaces::surely_bounding() const {
  std::vector<char> is_sure(all().size(), 0);
  for (const BoundaryHit& hit : boundary_hits(solid_.rays, known_, points_, kFewLines, run_)) {
    char& sure = is_sure[static_cast<std::size_t>(hit.halfspace)];
    if (!sure && changes_label(hit)) sure = 1;
  }
  std::vector<Halfspace> bounding;
  for (std::size_t k = 0; k < is_sure.size(); ++k) {
    if (is_sure[k]) bounding.push_back(all()[k]);
  }
  return bounding;
}

/// Where faces of operands touch, rounding can leave a gap that a line sees.
bool BoundingSurfaces::changes_label(const BoundaryHit& hit) const {
  const Vec3 step = 1e-7 * solid_.scale * hit.normal;
  return solid_.inside.contains(hit.position - step) &&
         !solid_.inside.contains(hit.position + step);
}

/// Whether the label changes for good there.
bool BoundingSurfaces::is_deep(const BoundaryHit& hit) const {
  const Vec3 step = 1.5 * solid_.depth * hit.normal;
  return solid_.inside.contains(hit.position - step) &&
         !solid_.inside.contains(hit.position + step) &&
         !is_free(solid_.rays, hit.position - step, solid_.depth) &&
         !is_free(solid_.rays, hit.position + step, solid_.depth);
}

void BoundingSurfaces::use(std::size_t halfspace) {
  int& place = place_[halfspace];
  if (place > 0) return;
  used_.halfspaces.push_back(all()[halfspace]);
  place = static_cast<int>(used_.halfspaces.size());
}

void BoundingSurfaces::find_frame_of(const std::vector<BoundaryHit>& hits) {
  std::vector<Vec3> positions;
  positions.reserve(hits.size());
  for (const BoundaryHit& hit : hits) positions.push_back(hit.position);
  frame_ = find_frame(make_mesh(std::move(positions), {}), {}, used_);
  for (int c = 0; c < 3; ++c) {
    const Vec3 axis = frame_.rotation.col(c);
    double lo = frame_.box.lo[c] - 0.01 * solid_.scale;
    double hi = frame_.box.hi[c] + 0.01 * solid_.scale;
    for (const Halfspace& h : used_.halfspaces) {
      const Surface& s = h.surface;
      if (s.kind != SurfaceKind::Plane || s.axis.cross(axis).norm() > 1e-9) continue;
      const double offset = s.axis.dot(axis) > 0 ? s.offset : -s.offset;
      if (std::abs(offset - frame_.box.lo[c]) < 1e-7 * solid_.scale) lo = offset;
      if (std::abs(offset - frame_.box.hi[c]) < 1e-7 * solid_.scale) hi = offset;
    }
    frame_.box.lo[c] = lo;
    frame_.box.hi[c] = hi;
  }
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) {
    const Vec3 pick((k & 1) != 0, (k & 2) != 0, (k & 4) != 0);
    corners.push_back(frame_.to_space(frame_.box.lo + pick.cwiseProduct(frame_.box.size())));
  }
  extent_ = make_mesh(std::move(corners), {});
}

bool BoundingSurfaces::use_separating(const SampleTable& table,
                                      const std::vector<std::vector<int>>& mixed) {
  const int best = best_separating(table, mixed);
  if (best < 0) return false;
  use(static_cast<std::size_t>(best));
  return true;
}

/// The unused surface that leaves the fewest points in the minority of their cell.
int BoundingSurfaces::best_separating(const SampleTable& table,
                                      const std::vector<std::vector<int>>& mixed) const {
  int best = -1;
  long best_gain = 0;
  for (std::size_t h = 0; h < place_.size(); ++h) {
    if (place_[h] > 0) continue;
    const long gain = gain_of(all()[h].surface, table, mixed);
    if (gain <= best_gain) continue;
    best_gain = gain;
    best = static_cast<int>(h);
  }
  return best;
}

}  // namespace hewn
