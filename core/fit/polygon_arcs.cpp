#include "core/fit/polygon_arcs.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hewn {
namespace {

/// More vertices are no short arc's.
constexpr std::size_t kMostPoints = 400;

/// Of what vertices may be off it: sides shorter than this are equal by chance.
constexpr double kShortestSide = 10;

/// A place across the axis with the vertices above each other there.
struct Place {
  Vec2 at;
  std::vector<Vec3> points;
};

double distance_from_line(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = (b - a).normalized();
  const Vec2 to = p - a;
  return std::abs(along.x() * to.y() - along.y() * to.x());
}

class PolygonArc {
 public:
  PolygonArc(const FitItem& item, const Vec3& axis, double exact) : exact_(exact) {
    const Tangents across = tangents(axis);
    const auto flat = [&](const Vec3& p) { return Vec2(across.u.dot(p), across.w.dot(p)); };
    for (const Vec3& p : item.points) add(flat(p), p);
    sort_around(flat(item.surface.point));
    find_corners();
  }

  /// The vertices at the corners, if they are those of a regular polygon on whose sides all others
  /// lie.
  std::optional<std::vector<Vec3>> corners() const {
    if (corners_.size() < 3) return std::nullopt;
    const double side = (at(1) - at(0)).norm();
    // What the vertices are off turns a side by that much, and its neighbour the other way.
    const double blur = 4 * exact_;
    if (side < kShortestSide * blur) return std::nullopt;
    const double turn = turn_at(1);
    for (std::size_t k = 0; k + 1 < corners_.size(); ++k) {
      if (std::abs((at(k + 1) - at(k)).norm() - side) > blur) return std::nullopt;
      if (k > 0 && std::abs(turn_at(k) - turn) * side > 2 * blur) return std::nullopt;
    }
    const std::size_t last = corners_.size() - 1;
    if (!ends_on_side(0, corners_.front(), at(0), at(0) + turned(at(0) - at(1), -turn)) ||
        !ends_on_side(corners_.back() + 1, places_.size(), at(last),
                      at(last) + turned(at(last) - at(last - 1), turn))) {
      return std::nullopt;
    }
    std::vector<Vec3> out;
    for (const std::size_t k : corners_) {
      out.insert(out.end(), places_[k].points.begin(), places_[k].points.end());
    }
    return out;
  }

 private:
  const Vec2& at(std::size_t corner) const { return places_[corners_[corner]].at; }

  void add(const Vec2& where, const Vec3& p) {
    const auto here = std::find_if(places_.begin(), places_.end(), [&](const Place& q) {
      return (q.at - where).norm() < 10 * exact_;
    });
    if (here == places_.end()) {
      places_.push_back({where, {p}});
    } else {
      here->points.push_back(p);
    }
  }

  /// Along the arc, beginning behind the widest gap.
  void sort_around(const Vec2& center) {
    const auto angle = [&](const Place& p) {
      return std::atan2(p.at.y() - center.y(), p.at.x() - center.x());
    };
    std::stable_sort(places_.begin(), places_.end(),
                     [&](const Place& a, const Place& b) { return angle(a) < angle(b); });
    std::size_t first = 0;
    double widest = 0;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const Place& before = places_[(k + places_.size() - 1) % places_.size()];
      const double gap = angle(places_[k]) - angle(before) + (k == 0 ? 2 * kPi : 0);
      if (gap > widest) {
        widest = gap;
        first = k;
      }
    }
    std::rotate(places_.begin(), places_.begin() + static_cast<long>(first), places_.end());
  }

  /// Where the outline turns. Its ends may lie anywhere on a side.
  void find_corners() {
    for (std::size_t k = 1; k + 1 < places_.size(); ++k) {
      const Vec2& before = places_[k - 1].at;
      const Vec2& behind = places_[k + 1].at;
      if (distance_from_line(places_[k].at, before, behind) > 2 * exact_) corners_.push_back(k);
    }
  }

  double turn_at(std::size_t corner) const {
    const Vec2 in = at(corner) - at(corner - 1);
    const Vec2 out = at(corner + 1) - at(corner);
    return std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
  }

  static Vec2 turned(const Vec2& v, double angle) { return Eigen::Rotation2Dd(angle) * v; }

  /// Whether the places from `begin` to `end` lie on the side between two corners.
  bool ends_on_side(std::size_t begin, std::size_t end, const Vec2& a, const Vec2& b) const {
    const double side = (b - a).norm();
    for (std::size_t k = begin; k < end; ++k) {
      const Vec2& p = places_[k].at;
      const double along = (p - a).dot(b - a) / side;
      if (along < -exact_ || along > side + 4 * exact_) return false;
      if (distance_from_line(p, a, b) > 4 * exact_) return false;
    }
    return true;
  }

  double exact_;
  std::vector<Place> places_;
  std::vector<std::size_t> corners_;  ///< ascending
};

void settle(FitItem& item, const Vec3& axis, double exact, double noise) {
  const auto corners = PolygonArc(item, axis, exact).corners();
  if (!corners) return;
  FitSettings settings;
  settings.keep_axis = true;
  settings.max_iterations = 50;
  settings.min_decrease = 1e-12;
  Surface s = item.surface;
  if (!refine_surface(s, {*corners}, settings)) return;
  const double sigma = rms_distance(s, *corners);
  if (sigma > exact) return;
  item.surface = s;
  item.points = *corners;
  item.sigma = std::max(noise, sigma);
  item.deviation = fit_deviation(s, *corners, item.sigma, true);
}

}  // namespace

void settle_polygon_arcs(std::vector<FitItem>& items, const std::vector<Vec3>& directions,
                         double exact, double noise) {
  for (FitItem& item : items) {
    const bool is_loose = item.surface.kind == SurfaceKind::Cylinder && item.sigma > exact;
    if (!is_loose || item.direction < 0 || item.points.size() > kMostPoints) continue;
    settle(item, directions[static_cast<std::size_t>(item.direction)], exact, noise);
  }
}

}  // namespace hewn
