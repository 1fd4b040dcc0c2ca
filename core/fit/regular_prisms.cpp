#include "core/fit/regular_prisms.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "core/fit/directions.h"
#include "core/fit/round_values.h"

namespace hewn {
namespace {

constexpr int kFewestSides = 5;
constexpr int kMostSides = 14;
constexpr double kSameAngleRad = 1e-3;  // the sides' own tolerances decide
/// Of the inscribed radius: sides that are off by less are the prism's, however exact their fit.
constexpr double kSameShare = 1e-4;
constexpr double kFlush = 1e-7;        // of the diagonal
constexpr long kMostTrials = 100'000;  // a part of many parallel planes in a star

/// A plane side that faces along one of the ring's directions. Far from the origin the normal's
/// last digits matter: it is the plane's own.
struct Side {
  HalfspaceSide of;
  Vec3 normal;  ///< unit, outward
  double offset = 0;
  double tolerance = 0;

  double distance_from(const Vec3& point) const { return offset - normal.dot(point); }
  double misfit(const RegularPrism& prism) const {
    return std::abs(distance_from(prism.center) - prism.radius);
  }
};

Side side_of(const SurfaceSet& surfaces, const HalfspaceSide& side) {
  const Halfspace& plane = surfaces.halfspaces[side.halfspace];
  const double sign = side.inside ? 1 : -1;
  return {side, sign * plane.surface.axis, sign * plane.surface.offset, plane.tolerance};
}

class PrismFinder {
 public:
  explicit PrismFinder(const SurfaceSet& surfaces) : surfaces_(surfaces) {
    planes_of_.resize(surfaces.directions.size());
    for (std::size_t h = 0; h < surfaces.halfspaces.size(); ++h) {
      const Halfspace& plane = surfaces.halfspaces[h];
      if (plane.surface.kind != SurfaceKind::Plane || plane.direction < 0) continue;
      planes_of_[plane.direction].push_back(static_cast<int>(h));
    }
  }

  std::vector<RegularPrism> run() {
    for (std::size_t i = 0; i < planes_of_.size(); ++i) {
      for (std::size_t j = 0; j < planes_of_.size(); ++j) {
        if (i != j && !planes_of_[i].empty() && !planes_of_[j].empty()) star(i, j);
      }
    }
    // A decagon's sides also make two pentagons: the larger one comes first.
    std::stable_sort(found_.begin(), found_.end(),
                     [](const auto& a, const auto& b) { return a.count() > b.count(); });
    return std::move(found_);
  }

 private:
  /// Prisms whose first two normals are the directions `i` and `j`, either way round.
  void star(std::size_t i, std::size_t j) {
    const Vec3& u = surfaces_.directions[i];
    const Vec3& v = surfaces_.directions[j];
    for (int n = kFewestSides; n <= kMostSides; ++n) {
      for (const double sign : {1.0, -1.0}) {
        const double angle = std::atan2(u.cross(v).norm(), sign * u.dot(v));
        if (std::abs(angle - 2 * kPi / n) > kSameAngleRad) continue;
        ring(n, u, known_direction(u.cross(sign * v).normalized()));
        ring(n, -u, known_direction((-u).cross(-sign * v).normalized()));
      }
    }
  }

  /// The part's own direction where there is one, so that its parallel planes close the ends.
  Vec3 known_direction(const Vec3& axis) const {
    for (const Vec3& d : surfaces_.directions) {
      if (d.cross(axis).norm() < kSameAngleRad) return d.dot(axis) < 0 ? Vec3(-d) : d;
    }
    return axis;
  }

  void ring(int n, const Vec3& normal, const Vec3& axis) {
    const Vec3 u = (normal - axis * axis.dot(normal)).normalized();
    const Vec3 w = axis.cross(u);
    std::vector<std::vector<Side>> sides;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * kPi * k / n;
      sides.push_back(sides_along(u * std::cos(angle) + w * std::sin(angle)));
      if (sides.back().empty()) return;
    }
    for (const Side& a : sides[0]) {
      for (const Side& b : sides[1]) {
        for (const Side& c : sides[2]) {
          if (++trials_ > kMostTrials) return;
          complete({a, b, c}, sides, {u, w, axis});
        }
      }
    }
  }

  std::vector<Side> sides_along(const Vec3& outward) const {
    std::vector<Side> sides;
    for (std::size_t d = 0; d < planes_of_.size(); ++d) {
      const Vec3& direction = surfaces_.directions[d];
      const double turn = direction.cross(outward).norm();
      if (turn > kSameAngleRad) continue;
      for (const int h : planes_of_[d]) {
        const bool inside = surfaces_.halfspaces[h].surface.axis.dot(outward) > 0;
        sides.push_back(side_of(surfaces_, {h, inside}));
      }
    }
    return sides;
  }

  struct Axes {
    Vec3 u, w, axis;
  };

  /// The first three sides give centre and radius; the others have to agree.
  void complete(const std::vector<Side>& first, const std::vector<std::vector<Side>>& sides,
                const Axes& axes) {
    Mat3 equations;
    Vec3 offsets;
    for (int k = 0; k < 3; ++k) {
      equations.row(k) << first[k].normal.dot(axes.u), first[k].normal.dot(axes.w), 1;
      offsets[k] = first[k].offset;
    }
    const Vec3 solution = equations.fullPivLu().solve(offsets);
    RegularPrism prism;
    prism.radius = solution.z();
    if (!(prism.radius > 0) || !solution.allFinite()) return;
    prism.axis = axes.axis;
    prism.normal = axes.u;
    prism.center = axes.u * solution.x() + axes.w * solution.y();
    for (const std::vector<Side>& alike : sides) {
      const std::optional<Side> side = nearest(alike, prism);
      if (!side) return;
      prism.sides.push_back(side->of);
    }
    if (is_within_tolerances(prism) && is_new(prism)) found_.push_back(std::move(prism));
  }

  static std::optional<Side> nearest(const std::vector<Side>& sides, const RegularPrism& prism) {
    const auto best = std::min_element(
        sides.begin(), sides.end(),
        [&](const Side& a, const Side& b) { return a.misfit(prism) < b.misfit(prism); });
    const double allowed = std::max(kSameShare * prism.radius, best->tolerance);
    if (best->misfit(prism) > allowed) return std::nullopt;
    return *best;
  }

  /// At the corners, where a turned side is off most.
  bool is_within_tolerances(const RegularPrism& prism) const {
    const double half_side = prism.radius * std::tan(kPi / prism.count());
    for (int k = 0; k < prism.count(); ++k) {
      const Vec3 normal = prism.side_normal(k);
      const Vec3 along = prism.axis.cross(normal);
      const Halfspace& plane = surfaces_.halfspaces[prism.sides[k].halfspace];
      for (const double end : {-half_side, half_side}) {
        const Vec3 corner = prism.center + normal * prism.radius + along * end;
        const double allowed = std::max(plane.tolerance, kSameShare * prism.radius);
        if (std::abs(plane.surface.signed_distance(corner)) > allowed) return false;
      }
    }
    return true;
  }

  /// Every prism turns up once for each of its sides.
  bool is_new(const RegularPrism& prism) {
    std::vector<std::pair<int, bool>> key;
    for (const HalfspaceSide& l : prism.sides) key.emplace_back(l.halfspace, l.inside);
    std::sort(key.begin(), key.end());
    return known_.insert(std::move(key)).second;
  }

  const SurfaceSet& surfaces_;
  std::vector<std::vector<int>> planes_of_;  // by direction
  std::set<std::vector<std::pair<int, bool>>> known_;
  std::vector<RegularPrism> found_;
  long trials_ = 0;
};

double largest_misfit(const RegularPrism& prism, const SurfaceSet& surfaces) {
  double largest = 0;
  for (const HalfspaceSide& side : prism.sides) {
    largest = std::max(largest, side_of(surfaces, side).misfit(prism));
  }
  return largest;
}

/// Centre and radius by least squares over all sides.
void fit_sides(RegularPrism& prism, const SurfaceSet& surfaces) {
  // The normals of a regular polygon sum to zero, their squares to half the number of sides.
  const double n = prism.count();
  Vec3 shift = Vec3::Zero();
  double radius = 0;
  for (int k = 0; k < prism.count(); ++k) {
    const double distance = side_of(surfaces, prism.sides[k]).distance_from(prism.center);
    radius += distance / n;
    shift += prism.side_normal(k) * (distance * 2 / n);
  }
  prism.radius = radius;
  prism.center += shift;
}

/// By how far the most exact side may move.
double least_allowed(const RegularPrism& prism, const SurfaceSet& surfaces) {
  double least = kInfinity;
  for (const HalfspaceSide& side : prism.sides) {
    least = std::min(least, surfaces.halfspaces[side.halfspace].tolerance);
  }
  return std::max(least, kSameShare * prism.radius);
}

/// A nut's inscribed circle has the round radius, a coarse circle's corners do.
double rounded_radius(const RegularPrism& prism, double tolerance) {
  const double share = std::cos(kPi / prism.count());
  const RoundValue inner = find_round_value(prism.radius, tolerance);
  const RoundValue outer = find_round_value(prism.radius / share, tolerance / share);
  return outer.exponent > inner.exponent ? outer.value * share : inner.value;
}

RegularPrism rounded(RegularPrism prism, double tolerance) {
  prism.radius = rounded_radius(prism, tolerance);
  if (!has_reference(prism.axis)) return prism;
  const Tangents f = reference_frame(prism.axis);
  prism.center = f.u * round_value(f.u.dot(prism.center), tolerance) +
                 f.w * round_value(f.w.dot(prism.center), tolerance);
  return prism;
}

/// On the ideal prism, round where no side moves too far for it.
RegularPrism settled(RegularPrism prism, const SurfaceSet& surfaces, bool is_flush,
                     bool round_values) {
  if (!is_flush) fit_sides(prism, surfaces);
  if (!round_values) return prism;
  const double allowed = least_allowed(prism, surfaces);
  RegularPrism round = rounded(prism, allowed);
  return largest_misfit(round, surfaces) <= allowed ? round : prism;
}

}  // namespace

Vec3 RegularPrism::side_normal(int k) const {
  const double angle = 2 * kPi * k / count();
  return normal * std::cos(angle) + axis.cross(normal) * std::sin(angle);
}

std::vector<int> settle_regular_prisms(SurfaceSet& surfaces, double diagonal, bool round_values) {
  std::set<int> moved;
  const double flush = kFlush * diagonal;
  for (const RegularPrism& found : find_regular_prisms(surfaces)) {
    const bool is_flush = largest_misfit(found, surfaces) < flush;
    const RegularPrism prism = settled(found, surfaces, is_flush, round_values);
    if (is_flush && largest_misfit(prism, surfaces) < flush) continue;
    // Prisms side by side may share the plane of a side: the first one's place for it counts.
    const bool agrees =
        std::all_of(prism.sides.begin(), prism.sides.end(), [&](const HalfspaceSide& s) {
          return moved.count(s.halfspace) == 0 || side_of(surfaces, s).misfit(prism) < flush;
        });
    if (!agrees) continue;
    for (const HalfspaceSide& side : prism.sides) {
      if (!moved.insert(side.halfspace).second) continue;
      // Along the plane's own normal, which is its direction exactly.
      Surface& plane = surfaces.halfspaces[side.halfspace].surface;
      plane.offset = plane.axis.dot(prism.center) + (side.inside ? prism.radius : -prism.radius);
    }
  }
  return {moved.begin(), moved.end()};
}

std::vector<RegularPrism> find_regular_prisms(const SurfaceSet& surfaces) {
  return PrismFinder(surfaces).run();
}

}  // namespace hewn
