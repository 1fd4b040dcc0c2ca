#include "core/fit/directions.h"

#include <algorithm>
#include <optional>

#include "core/fit/round_values.h"

namespace hewn {
namespace {

constexpr double kMinTurn = 1e-4;          // radians: directions closer than this are one
constexpr double kMinDeviation = 1e-9;     // radians: no fit is more exact
constexpr double kMaxUncertainTurn = 0.1;  // radians
constexpr double kExactlyAcross = 1e-14;
constexpr double kRounding = 1e-12;  // of a cosine

struct Cluster {
  Vec3 axis = Vec3::Zero();
  Vec3 sum = Vec3::Zero();
  double weight = 0;  ///< inverse variance
  double area = 0;
  double extent = 0;
  bool is_fixed = false;  ///< a coordinate axis
  int items = 0;
  int joined = -1;  ///< the settled cluster that took this one

  double deviation() const { return weight > 0 ? 1 / std::sqrt(weight) : kPi; }
};

double unsigned_angle(const Vec3& a, const Vec3& b) {
  const double angle = angle_between(a, b);
  return std::min(angle, kPi - angle);
}

/// The angle that two sides of a regular polygon of 5, 6, 8, 10 or 12 sides make, if one is near.
std::optional<double> polygon_angle(double angle_rad, double tolerance_rad) {
  for (const double step : {kPi / 12, kPi / 10}) {
    const double nearest = std::round(angle_rad / step) * step;
    if (std::abs(nearest - angle_rad) <= tolerance_rad) return nearest;
  }
  return std::nullopt;
}

class DirectionFinder {
 public:
  DirectionFinder(double diagonal, const RegulariseOptions& options)
      : reach_(options.snap_distance * diagonal),
        max_turn_(options.max_turn_deg * kPi / 180),
        options_(options) {
    for (int k = 0; k < 3; ++k) {
      Cluster c;
      c.axis = Vec3::Unit(k);
      c.is_fixed = true;
      clusters_.push_back(c);
    }
  }

  std::vector<Vec3> run(std::vector<FitItem>& items) {
    for (FitItem& item : items) {
      if (item.surface.kind != SurfaceKind::Sphere) join(item);
    }
    std::vector<int> order;
    for (int k = 3; k < static_cast<int>(clusters_.size()); ++k) order.push_back(k);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return clusters_[a].area > clusters_[b].area; });
    for (int k = 0; k < 3; ++k) settled_.push_back(k);
    for (const int k : order) settle(k);
    return compact(items);
  }

 private:
  /// By how much a surface may turn: its far end stays within reach, or the turn is within the
  /// fit's own deviation (a narrow face may turn about its long side).
  double limit(double extent, double deviation) const {
    const double turn = std::clamp(reach_ / std::max(extent, 1e-300), kMinTurn, max_turn_);
    return std::max(turn, std::min(options_.round_deviations * deviation, kMaxUncertainTurn));
  }

  void join(FitItem& item) {
    double best = limit(item.extent, item.deviation.axis_rad);
    double reached = std::cos(best) - kRounding;
    int found = -1;
    for (int k = 0; k < static_cast<int>(clusters_.size()); ++k) {
      if (k == 3 && found >= 0) break;  // a coordinate axis wins over a nearer neighbour
      // The exact angle costs more; few get near.
      if (std::abs(clusters_[k].axis.dot(item.surface.axis)) < reached) continue;
      const double angle = unsigned_angle(clusters_[k].axis, item.surface.axis);
      if (angle < best) {
        best = angle;
        reached = std::cos(best) - kRounding;
        found = k;
      }
    }
    if (found < 0) {
      found = static_cast<int>(clusters_.size());
      clusters_.push_back({});
      clusters_.back().axis = item.surface.axis;
    }
    Cluster& c = clusters_[found];
    const double deviation = std::max(item.deviation.axis_rad, kMinDeviation);
    const double weight = 1 / (deviation * deviation);
    c.sum += item.surface.axis * (c.axis.dot(item.surface.axis) < 0 ? -weight : weight);
    c.weight += weight;
    c.area += item.area;
    c.extent = std::max(c.extent, item.extent);
    ++c.items;
    item.direction = found;
  }

  /// Snaps one cluster to those that are settled, or joins it to one of them.
  void settle(int index) {
    Cluster& c = clusters_[index];
    c.axis = c.sum.normalized();
    const double allowed = limit(c.extent, c.deviation());
    for (const int k : settled_) {
      if (unsigned_angle(clusters_[k].axis, c.axis) > allowed) continue;
      c.joined = k;
      ++clusters_[k].items;
      return;
    }
    if (const std::optional<Vec3> snapped = orthogonal(c, allowed)) c.axis = *snapped;
    int largest = 0;
    c.axis.cwiseAbs().maxCoeff(&largest);
    if (c.axis[largest] < 0) c.axis = -c.axis;
    c.axis += Vec3::Zero();  // no negative zeros
    settled_.push_back(index);
  }

  std::optional<Vec3> orthogonal(const Cluster& c, double allowed) const {
    std::vector<Vec3> across;
    for (const int k : settled_) {
      const Vec3& s = clusters_[k].axis;
      if (std::abs(s.dot(c.axis)) <= std::sin(allowed)) across.push_back(s);
    }
    for (std::size_t i = 0; i < across.size(); ++i) {
      for (std::size_t j = i + 1; j < across.size(); ++j) {
        const Vec3 normal = across[i].cross(across[j]);
        if (normal.norm() < 0.1) continue;
        const Vec3 candidate = normal.normalized();
        if (unsigned_angle(candidate, c.axis) <= allowed) {
          return candidate.dot(c.axis) < 0 ? Vec3(-candidate) : candidate;
        }
      }
    }
    if (across.empty()) return std::nullopt;
    const Vec3 projected = (c.axis - across[0] * across[0].dot(c.axis)).normalized();
    return rounded_within_plane(projected, across[0], c, allowed);
  }

  /// `axis` lies in the plane across `normal`; its angle to a settled direction there may be that
  /// of a regular polygon, or a round one. The roundest counts: a hexagon's sides meet at 60
  /// degrees, however it is turned.
  Vec3 rounded_within_plane(const Vec3& axis, const Vec3& normal, const Cluster& c,
                            double allowed) const {
    if (!options_.round_values) return axis;
    const double tolerance =
        std::min(allowed, options_.round_deviations * c.deviation() + kMinDeviation);
    Vec3 roundest = axis;
    RoundValue best;
    for (const int k : settled_) {
      const Vec3& x = clusters_[k].axis;
      if (std::abs(x.dot(normal)) > kExactlyAcross) continue;
      const Vec3 y = normal.cross(x);
      const auto turned = [&](double angle) {
        return (x * std::cos(angle) + y * std::sin(angle)).normalized();
      };
      const double angle = std::atan2(axis.dot(y), axis.dot(x));
      if (const auto regular = polygon_angle(angle, std::min(allowed, kMinTurn))) {
        return turned(*regular);
      }
      const RoundValue rounded = find_round_angle(angle, tolerance);
      if (rounded.exponent <= best.exponent) continue;
      best = rounded;
      roundest = turned(rounded.value);
    }
    return roundest;
  }

  /// Drops unused coordinate axes and renumbers.
  std::vector<Vec3> compact(std::vector<FitItem>& items) const {
    std::vector<int> index(clusters_.size(), -1);
    std::vector<Vec3> directions;
    for (std::size_t k = 0; k < clusters_.size(); ++k) {
      if (clusters_[k].items == 0 || clusters_[k].joined >= 0) continue;
      index[k] = static_cast<int>(directions.size());
      directions.push_back(clusters_[k].axis);
    }
    for (FitItem& item : items) {
      if (item.direction < 0) continue;
      const int joined = clusters_[item.direction].joined;
      item.direction = index[joined >= 0 ? joined : item.direction];
    }
    return directions;
  }

  double reach_, max_turn_;
  const RegulariseOptions& options_;
  std::vector<Cluster> clusters_;
  std::vector<int> settled_;
};

/// The coordinate axis exactly across `axis`; -1 when there is none.
int axis_across(const Vec3& axis) {
  for (int k = 2; k >= 0; --k) {
    if (axis[k] == 0) return k;
  }
  return -1;
}

}  // namespace

std::vector<Vec3> assign_directions(std::vector<FitItem>& items, double diagonal,
                                    const RegulariseOptions& options) {
  return DirectionFinder(diagonal, options).run(items);
}

Tangents reference_frame(const Vec3& axis) {
  for (int k = 0; k < 3; ++k) {
    if (std::abs(axis[k]) != 1) continue;
    const Vec3 u = Vec3::Unit((k + 1) % 3);
    return {u, axis.cross(u)};
  }
  const int across = axis_across(axis);
  if (across < 0) return tangents(axis);
  const Vec3 u = Vec3::Unit(across);
  return {u, axis.cross(u)};
}

bool has_reference(const Vec3& axis) { return axis_across(axis) >= 0; }

}  // namespace hewn
