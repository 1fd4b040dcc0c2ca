#include "core/sample/separate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/compute/parallel.h"
#include "core/sample/separating_plane.h"

namespace hewn {
namespace {

constexpr std::size_t kMaxCandidates = 1500;
constexpr std::size_t kMaxAxisDirections = 40;
constexpr int kMaxAdded = 40;
constexpr double kWorthLooking = 5e-4;  // share of conflicting points
constexpr double kGoodEnough = 3e-4;
constexpr double kSamePlane = 1.5e-4;  // of the diagonal
constexpr double kSameDirection = 1e-4;
constexpr double kMaxShift = 1.5e-4;  // of the diagonal, by which snapping moves a plane's far end
constexpr double kMaxTurn = 0.01;     // rad; however small the surface that implies the plane
constexpr double kAngleStep = kPi / 12;
constexpr double kExactlyAcross = 1e-12;
/// What a plane of a new direction counts beside one along or across the part's own surfaces.
constexpr double kNewDirection = 0.85;
/// What two planes count beside one.
constexpr double kTwoPlanes = 0.95;
constexpr double kOpenArc = 0.4;  // rad; a smaller gap is a closed turn

/// Collects candidate halfspaces without repeating any.
class CandidatePool {
 public:
  CandidatePool(const SampleSpace& space, SurfaceSet& surfaces)
      : diagonal_(space.diagonal), surfaces_(&surfaces) {}

  int add_plane(const Vec3& normal, double offset) {
    return add_plane_along(direction_of(normal, kSameDirection), normal, offset);
  }

  void add_plane_through(const Vec3& normal, const Vec3& point) {
    add_plane(normal, normal.dot(point));
  }

  /// A plane that a surface along `axis` implies: across the axis, or containing it. Its normal is
  /// only as certain as the surface's `extent` tells, so it snaps to a known direction, or to a
  /// multiple of 15 degrees from one.
  int add_snapped_plane(const Vec3& normal, const Vec3& point, const Vec3& axis, double extent) {
    const double shift = kMaxShift * diagonal_;
    const double turn = std::clamp(shift / std::max(extent, 1e-300), kSameDirection, kMaxTurn);
    const int direction = direction_of(snapped(normal, axis, turn), turn);
    const Vec3& snapped_normal = surfaces_->directions[direction];
    return add_plane_along(direction, snapped_normal, snapped_normal.dot(point));
  }

  int add_plane_along(int direction, const Vec3& normal, double offset) {
    const Halfspace h =
        separating_plane(surfaces_->directions, direction, normal, offset, diagonal_);
    if (find(surfaces_->halfspaces, h) >= 0) return -1;
    const int known = find(pool_, h);
    if (known >= 0) return known;
    pool_.push_back(h);
    return static_cast<int>(pool_.size()) - 1;
  }

  void add_cylinder(const Halfspace& torus) {
    Halfspace h = torus;
    h.is_separating = true;
    h.tolerance = 1e-6 * diagonal_;
    h.area = 0;
    h.surface.kind = SurfaceKind::Cylinder;
    h.surface.radius = torus.surface.major_radius;
    pool_.push_back(h);
  }

  /// Two planes that only together cut off what lies beyond an arc.
  void add_pair(int a, int b) {
    if (a >= 0 && b >= 0 && a != b) pairs_.push_back({a, b});
  }

  SeparatingCandidates take() {
    if (pool_.size() > kMaxCandidates) pool_.resize(kMaxCandidates);
    std::erase_if(pairs_, [this](const std::array<int, 2>& pair) {
      return std::max(pair[0], pair[1]) >= static_cast<int>(pool_.size());
    });
    return {std::move(pool_), std::move(pairs_)};
  }

 private:
  /// The nearest known direction within `turn`, else a new one.
  int direction_of(const Vec3& normal, double turn) {
    auto& directions = surfaces_->directions;
    int best = -1;
    double best_sine = std::sin(turn);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double sine = directions[i].cross(normal).norm();
      if (sine >= best_sine) continue;
      best_sine = sine;
      best = static_cast<int>(i);
    }
    if (best >= 0) return best;
    directions.push_back(normal);
    return static_cast<int>(directions.size()) - 1;
  }

  /// `normal` turned about `axis` to a multiple of 15 degrees from a known direction across it.
  Vec3 snapped(const Vec3& normal, const Vec3& axis, double turn) const {
    for (const Vec3& d : surfaces_->directions) {
      if (std::abs(d.dot(axis)) > kExactlyAcross) continue;
      const Vec3 e = axis.cross(d);
      const double angle = std::atan2(normal.dot(e), normal.dot(d));
      const double steps = std::round(angle / kAngleStep);
      if (std::abs(angle - steps * kAngleStep) > turn) continue;
      return (d * std::cos(steps * kAngleStep) + e * std::sin(steps * kAngleStep)).normalized();
    }
    return normal;
  }

  /// Index of a plane in the list, or -1.
  int find(const std::vector<Halfspace>& list, const Halfspace& plane) const {
    const auto same = std::find_if(list.begin(), list.end(), [&](const Halfspace& h) {
      return h.surface.kind == SurfaceKind::Plane && h.direction == plane.direction &&
             std::abs(h.surface.offset - plane.surface.offset) < kSamePlane * diagonal_;
    });
    return same == list.end() ? -1 : static_cast<int>(same - list.begin());
  }

  double diagonal_;
  SurfaceSet* surfaces_;
  std::vector<Halfspace> pool_;
  std::vector<std::array<int, 2>> pairs_;
};

std::vector<Vec3> group_vertices(const Mesh& mesh, const FaceGroup& group) {
  std::vector<int> ids;
  for (const int t : group.triangles) {
    ids.insert(ids.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::vector<Vec3> out;
  out.reserve(ids.size());
  for (const int v : ids) out.push_back(mesh.vertices[v]);
  return out;
}

void add_extents(CandidatePool& pool, const Vec3& direction, const std::vector<Vec3>& points) {
  double lo = kInfinity;
  double hi = -kInfinity;
  for (const Vec3& p : points) {
    lo = std::min(lo, direction.dot(p));
    hi = std::max(hi, direction.dot(p));
  }
  pool.add_plane(direction, lo);
  pool.add_plane(direction, hi);
}

/// The azimuths at which an open arc begins and ends; false when the points go all the way round.
bool find_arc(const Surface& s, const Tangents& frame, const std::vector<Vec3>& points,
              double& begin, double& end) {
  std::vector<double> azimuths;
  azimuths.reserve(points.size());
  for (const Vec3& p : points) {
    azimuths.push_back(std::atan2(frame.w.dot(p - s.point), frame.u.dot(p - s.point)));
  }
  std::sort(azimuths.begin(), azimuths.end());
  double gap = azimuths.front() + 2 * kPi - azimuths.back();
  begin = azimuths.back();
  end = azimuths.front();
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    if (azimuths[i] - azimuths[i - 1] > gap) {
      gap = azimuths[i] - azimuths[i - 1];
      begin = azimuths[i - 1];
      end = azimuths[i];
    }
  }
  return gap > kOpenArc;
}

/// Planes through the ends of an arc: radial, tangential-to-axis and the chord between them.
void add_arc_planes(CandidatePool& pool, const Surface& s, const std::vector<Vec3>& points) {
  const Tangents frame = tangents(s.axis);
  double ends[2];
  if (!find_arc(s, frame, points, ends[0], ends[1])) return;
  double extent = 0;
  for (const Vec3& p : points) extent = std::max(extent, s.axis.cross(p - s.point).norm());
  Vec3 rim[2];
  int radial[2];
  for (int k = 0; k < 2; ++k) {
    const Vec3 outward = frame.u * std::cos(ends[k]) + frame.w * std::sin(ends[k]);
    radial[k] = pool.add_snapped_plane(s.axis.cross(outward), s.point, s.axis, extent);
    if (s.kind == SurfaceKind::Cylinder) {
      pool.add_snapped_plane(outward, s.point, s.axis, extent);
    }
    rim[k] = s.point + outward * (s.kind == SurfaceKind::Torus ? s.major_radius : s.radius);
  }
  pool.add_pair(radial[0], radial[1]);
  if (s.kind == SurfaceKind::Cone) return;
  const Vec3 chord_normal = s.axis.cross(rim[1] - rim[0]);
  if (chord_normal.norm() > 1e-6 * (rim[1] - rim[0]).norm() && (rim[1] - rim[0]).norm() > 0) {
    const Vec3 middle = (rim[0] + rim[1]) / 2;
    pool.add_snapped_plane(chord_normal.normalized(), middle, s.axis, (rim[1] - rim[0]).norm());
  }
}

void add_group_planes(CandidatePool& pool, const Halfspace& h, const std::vector<Vec3>& points,
                      const std::vector<Vec3>& directions) {
  const Surface& s = h.surface;
  if (s.kind == SurfaceKind::Sphere) {
    for (std::size_t k = 0; k < std::min<std::size_t>(directions.size(), 12); ++k) {
      pool.add_plane_through(directions[k], s.point);
      add_extents(pool, directions[k], points);
    }
    return;
  }
  add_extents(pool, s.axis, points);
  if (s.kind == SurfaceKind::Torus) {
    pool.add_plane_through(s.axis, s.point);
    pool.add_cylinder(h);
  }
  add_arc_planes(pool, s, points);
  for (const Vec3& d : directions) {
    if (std::abs(d.dot(s.axis)) < 1e-3) pool.add_plane_through(d, s.point);
  }
}

/// The conflicting points, cell by cell, with the side of every candidate on which each lies.
struct Conflict {
  std::vector<std::size_t> points;
  std::vector<std::vector<Word>> sides;  ///< per candidate, a bit per point
};

Conflict gather_conflict(const SampleTable& table, const Cells& cells,
                         const std::vector<Halfspace>& candidates, const RunContext& run) {
  Conflict c;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const int cell = cells.cell_of_point[i];
    if (std::min(cells.inside_count[cell], cells.outside_count[cell]) > 0) c.points.push_back(i);
  }
  c.sides.resize(candidates.size());
  for_each_index(run.threads, candidates.size(), [&](std::size_t k) {
    c.sides[k].assign((c.points.size() + 63) / 64, 0);
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      if (candidates[k].surface.signed_distance(table.points[c.points[i]]) < 0) {
        set_bit(c.sides[k].data(), i);
      }
    }
  });
  return c;
}

/// One candidate, or two that are added together.
struct Choice {
  std::array<int, 2> candidates = {-1, -1};
  double weight = 1;  ///< of the points that it resolves
};

/// Conflicting points that a choice would resolve. `counts` is scratch memory.
long resolved_by(const Conflict& conflict, const Choice& choice, const SampleTable& table,
                 const Cells& cells, std::vector<int>& counts) {
  // By cell, the part of it that the planes cut off, and label.
  counts.assign(8 * cells.size(), 0);
  const Word* first = conflict.sides[static_cast<std::size_t>(choice.candidates[0])].data();
  const Word* second = choice.candidates[1] < 0
                           ? nullptr
                           : conflict.sides[static_cast<std::size_t>(choice.candidates[1])].data();
  for (std::size_t i = 0; i < conflict.points.size(); ++i) {
    const std::size_t p = conflict.points[i];
    const std::size_t part =
        (test_bit(first, i) ? 1U : 0U) + (second != nullptr && test_bit(second, i) ? 2U : 0U);
    ++counts[8 * static_cast<std::size_t>(cells.cell_of_point[p]) + 2 * part +
             (table.is_inside[p] ? 1U : 0U)];
  }
  long total = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    int all[2] = {0, 0};
    for (std::size_t part = 0; part < 4; ++part) {
      const int* of_part = &counts[8 * c + 2 * part];
      all[0] += of_part[0];
      all[1] += of_part[1];
      total -= std::min(of_part[0], of_part[1]);
    }
    total += std::min(all[0], all[1]);
  }
  return total;
}

/// Every candidate on its own, and the pairs whose planes lie along or across the part's own
/// surfaces.
std::vector<Choice> choices_among(const SeparatingCandidates& found, int own_directions,
                                  ArcCut cut) {
  const auto is_own = [&](int k) {
    return found.halfspaces[static_cast<std::size_t>(k)].direction < own_directions;
  };
  std::vector<Choice> choices;
  choices.reserve(found.halfspaces.size() + found.pairs.size());
  for (int k = 0; k < static_cast<int>(found.halfspaces.size()); ++k) {
    choices.push_back({{k, -1}, is_own(k) ? 1 : kNewDirection});
  }
  if (cut == ArcCut::Chord) return choices;
  for (const auto& [a, b] : found.pairs) {
    if (is_own(a) && is_own(b)) choices.push_back({{a, b}, kTwoPlanes});
  }
  return choices;
}

}  // namespace

SeparatingCandidates separating_candidates(const SampleSpace& space, SurfaceSet& surfaces) {
  CandidatePool pool(space, surfaces);
  const auto end = surfaces.directions.begin() +
                   static_cast<long>(std::min(surfaces.directions.size(), kMaxAxisDirections));
  const std::vector<Vec3> directions(surfaces.directions.begin(), end);
  for (std::size_t g = 0; g < space.segmentation->groups.size(); ++g) {
    const int index = surfaces.halfspace_of_group[g];
    if (index < 0 || !space.label->owns_group(static_cast<int>(g))) continue;
    const Halfspace h = surfaces.halfspaces[index];
    if (h.surface.kind == SurfaceKind::Plane) continue;
    add_group_planes(pool, h, group_vertices(space.mesh(), space.segmentation->groups[g]),
                     directions);
  }
  for (int c = 0; c < 3; ++c) {
    const Vec3 axis = space.frame.rotation.col(c);
    pool.add_plane(axis, space.frame.box.lo[c]);
    pool.add_plane(axis, space.frame.box.hi[c]);
  }
  return pool.take();
}

Separation add_separating_halfspaces(const SampleSpace& space, SurfaceSet& surfaces,
                                     SampleTable& table, Cells& cells, ArcCut cut,
                                     const RunContext& run) {
  const auto points = static_cast<double>(table.size());
  const auto share = [&] { return static_cast<double>(cells.conflicting_points()) / points; };
  if (share() < kWorthLooking) return {};
  const int own_directions = static_cast<int>(surfaces.directions.size());
  const SeparatingCandidates found = separating_candidates(space, surfaces);
  const std::vector<Choice> choices = choices_among(found, own_directions, cut);
  const Conflict conflict = gather_conflict(table, cells, found.halfspaces, run);
  Separation done;
  while (done.added < kMaxAdded && share() >= kGoodEnough && !run.is_cancelled()) {
    std::vector<double> resolved(choices.size(), 0);
    for_each_chunk(run.threads, choices.size(), 64, [&](std::size_t begin, std::size_t end) {
      std::vector<int> counts;
      for (std::size_t k = begin; k < end; ++k) {
        resolved[k] = choices[k].weight *
                      static_cast<double>(resolved_by(conflict, choices[k], table, cells, counts));
      }
    });
    const auto best = std::max_element(resolved.begin(), resolved.end());
    if (best == resolved.end() || *best < std::max(2.0, 2e-5 * points)) break;
    const Choice& choice = choices[static_cast<std::size_t>(best - resolved.begin())];
    for (const int k : choice.candidates) {
      if (k < 0) continue;
      surfaces.halfspaces.push_back(found.halfspaces[static_cast<std::size_t>(k)]);
      ++done.added;
    }
    done.corners += choice.candidates[1] < 0 ? 0 : 1;
    append_halfspaces(table, surfaces.halfspaces, run);
    cells = find_cells(table, run);
  }
  return done;
}

}  // namespace hewn
