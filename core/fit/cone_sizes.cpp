#include "core/fit/cone_sizes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/fit/round_values.h"
#include "core/fit/snap_rule.h"

namespace hewn {
namespace {

constexpr double kAcross = 1e-9;
/// At the end of a line through points the error of the fit is about twice that in the middle.
constexpr double kAtEnds = 2;

class ConeSettler {
 public:
  ConeSettler(FitItem& item, const std::vector<FitItem>& items, double diagonal, double noise,
              const RegulariseOptions& options)
      : item_(item), cone_(item.surface), options_(options), snap_(options, diagonal, noise) {
    find_caps(items);
  }

  void settle() {
    if (caps_.size() == 2 && settle_both_radii()) return;
    settle_angle();
    settle_along();
  }

 private:
  double apex() const { return cone_.axis.dot(cone_.point); }
  void move_apex(double height) { cone_.point += (height - apex()) * cone_.axis; }
  double radius_at(double height) const {
    return (height - apex()) * std::tan(cone_.half_angle_rad);
  }

  /// What a distance from the surface may be off by, as far as the points can tell.
  double tolerance() const {
    return snap_.tolerance(item_.sigma / std::sqrt(static_cast<double>(item_.points.size())));
  }

  /// The heights along the axis of the planes across it in which the cone begins and ends.
  void find_caps(const std::vector<FitItem>& items) {
    double lo = kInfinity;
    double hi = -kInfinity;
    for (const Vec3& p : item_.points) {
      lo = std::min(lo, cone_.axis.dot(p));
      hi = std::max(hi, cone_.axis.dot(p));
    }
    for (const double end : {lo, hi}) {
      std::optional<double> nearest;
      for (const FitItem& other : items) {
        const Surface& s = other.surface;
        if (s.kind != SurfaceKind::Plane || s.axis.cross(cone_.axis).norm() > kAcross) continue;
        const double height = s.axis.dot(cone_.axis) < 0 ? -s.offset : s.offset;
        if (std::abs(height - end) > (nearest ? std::abs(*nearest - end) : snap_.reach)) continue;
        nearest = height;
      }
      if (nearest) caps_.push_back(*nearest);
    }
  }

  bool settle_both_radii() {
    const double length = caps_[1] - caps_[0];
    if (!(length > snap_.reach)) return false;
    const double most = kAtEnds * tolerance() / std::cos(cone_.half_angle_rad);
    const RoundValue small = find_round_value(radius_at(caps_[0]), most);
    const RoundValue large = find_round_value(radius_at(caps_[1]), most);
    if (!small.is_round() || !large.is_round() || !(large.value > small.value)) return false;
    const double slope = (large.value - small.value) / length;
    cone_.half_angle_rad = std::atan(slope);
    move_apex(caps_[0] - small.value / slope);
    return true;
  }

  void settle_angle() {
    const double turn = snap_.reach / std::max(item_.extent, 1e-300);
    const double most = std::min(options_.round_deviations * item_.deviation.half_angle_rad, turn);
    const double angle = round_angle(cone_.half_angle_rad, most);
    if (angle == cone_.half_angle_rad) return;
    cone_.half_angle_rad = angle;
    refit_apex();
  }

  /// The apex that fits the points best when the half angle is kept.
  void refit_apex() {
    double sum = 0;
    for (const Vec3& p : item_.points) sum += cone_.signed_distance(p);
    // Moving the apex by t along the axis changes every distance by t sin(half angle).
    const double mean = sum / static_cast<double>(item_.points.size());
    cone_.point -= cone_.axis * (mean / std::sin(cone_.half_angle_rad));
  }

  void settle_along() {
    const double slope = std::tan(cone_.half_angle_rad);
    const double most = tolerance() / std::sin(cone_.half_angle_rad);
    RoundValue best = find_round_value(apex(), most);
    double place = best.value;
    for (const double cap : caps_) {
      const RoundValue radius = find_round_value(radius_at(cap), most * slope);
      if (!radius.is_round() || radius.value <= 0 || radius.exponent < best.exponent) continue;
      best = radius;
      place = cap - radius.value / slope;
    }
    if (best.is_round()) move_apex(place);
  }

  FitItem& item_;
  Surface& cone_;
  const RegulariseOptions& options_;
  SnapRule snap_;
  std::vector<double> caps_;  ///< ascending
};

}  // namespace

void settle_cone_sizes(std::vector<FitItem>& items, double diagonal, double noise,
                       const RegulariseOptions& options) {
  if (!options.round_values) return;
  for (FitItem& item : items) {
    if (item.surface.kind != SurfaceKind::Cone || item.points.empty()) continue;
    ConeSettler(item, items, diagonal, noise, options).settle();
  }
}

}  // namespace hewn
