#include "core/fit/short_arcs.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hewn {
namespace {

/// Where a loose arc may belong.
struct Candidate {
  Vec3 point = Vec3::Zero();     ///< on the axis
  std::optional<double> radius;  ///< when it is known, too
  double deviation = 0;          ///< of the point
};

class ArcSettler {
 public:
  ArcSettler(std::vector<FitItem>& items, const std::vector<Vec3>& directions, const SnapRule& snap,
             double exact)
      : items_(items), directions_(directions), snap_(snap), exact_(exact) {}

  void run() {
    for (int d = 0; d < static_cast<int>(directions_.size()); ++d) settle(d);
  }

 private:
  bool is_loose(const FitItem& item) const {
    return item.sigma > exact_ || snap_.deviations * item.deviation.position > snap_.reach;
  }

  Vec3 across(const Vec3& p) const { return p - axis_ * axis_.dot(p); }

  void settle(int direction) {
    axis_ = directions_[static_cast<std::size_t>(direction)];
    std::vector<FitItem*> loose;
    std::vector<Candidate> candidates;
    for (FitItem& item : items_) {
      const SurfaceKind kind = item.surface.kind;
      if (item.direction != direction) continue;
      if (kind == SurfaceKind::Cylinder && is_loose(item)) {
        loose.push_back(&item);
      } else if (kind == SurfaceKind::Cylinder || kind == SurfaceKind::Cone) {
        add_candidate(item, candidates);
      }
    }
    if (loose.empty()) return;
    if (const auto joint = fit_together(loose)) candidates.push_back(*joint);
    // Those that three vertices place make a circle known on which two are enough for others.
    for (int pass = 0; pass < 2; ++pass) {
      std::vector<Candidate> found;
      std::erase_if(loose, [&](FitItem* item) {
        return std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& c) {
          if (!adopt(*item, c)) return false;
          found.push_back({c.point, item->surface.radius, c.deviation});
          return true;
        });
      });
      candidates.insert(candidates.end(), found.begin(), found.end());
    }
  }

  void add_candidate(const FitItem& item, std::vector<Candidate>& candidates) const {
    const Vec3 at = across(item.surface.point);
    const auto is_here = [&](const Candidate& c) { return (c.point - at).norm() < exact_; };
    if (std::any_of(candidates.begin(), candidates.end(), is_here)) return;
    candidates.push_back({at, std::nullopt, item.deviation.position});
  }

  /// One circle for all loose arcs; vertices on chords count little.
  std::optional<Candidate> fit_together(const std::vector<FitItem*>& loose) const {
    if (loose.size() < 2) return std::nullopt;
    std::vector<Vec3> points;
    Surface s = loose.front()->surface;
    for (const FitItem* item : loose) {
      points.insert(points.end(), item->points.begin(), item->points.end());
    }
    FitSettings settings;
    settings.keep_axis = true;
    settings.robust_scale = exact_;
    settings.max_iterations = 60;
    settings.min_decrease = 1e-9;
    if (!refine_surface(s, {points}, settings)) return std::nullopt;
    return Candidate{across(s.point), std::nullopt, exact_};
  }

  /// The radius at which most of the item's vertices lie, of equally many the largest.
  double common_radius(const FitItem& item, const Vec3& center) const {
    std::vector<double> radii;
    for (const Vec3& p : item.points) radii.push_back((across(p) - center).norm());
    std::sort(radii.begin(), radii.end());
    double best = 0;
    std::size_t most = 0;
    for (std::size_t lo = 0, hi = 0; hi < radii.size(); ++hi) {
      while (radii[hi] - radii[lo] > 2 * exact_) ++lo;
      if (hi - lo + 1 < most) continue;
      most = hi - lo + 1;
      best = (radii[lo] + radii[hi]) / 2;
    }
    return best;
  }

  /// What of an arc lies on a circle about the axis.
  struct OnCircle {
    std::vector<Vec3> points;
    std::vector<Vec3> places;  ///< of the points, each once
    double deepest = 0;        ///< of the others, which are nearer to the axis
  };

  /// Nothing when a vertex lies beyond the circle.
  std::optional<OnCircle> split(const FitItem& item, const Vec3& center, double radius) const {
    OnCircle out;
    for (const Vec3& p : item.points) {
      const Vec3 at = across(p);
      const double beyond = (at - center).norm() - radius;
      if (beyond > exact_) return std::nullopt;
      out.deepest = std::max(out.deepest, -beyond);
      if (beyond < -exact_) continue;
      out.points.push_back(p);
      const auto is_here = [&](const Vec3& q) { return (q - at).norm() < 10 * exact_; };
      if (std::none_of(out.places.begin(), out.places.end(), is_here)) out.places.push_back(at);
    }
    return out;
  }

  /// How far a chord between the two nearest places is from the circle.
  static double sagitta(const std::vector<Vec3>& places, double radius) {
    double shortest = kInfinity;
    for (std::size_t a = 0; a < places.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        shortest = std::min(shortest, (places[a] - places[b]).squaredNorm());
      }
    }
    const double apothem = std::sqrt(std::max(0.0, radius * radius - shortest / 4));
    return places.size() < 2 ? 0 : radius - apothem;
  }

  bool adopt(FitItem& item, const Candidate& candidate) const {
    const double radius =
        candidate.radius ? *candidate.radius : common_radius(item, candidate.point);
    std::optional<OnCircle> split_item = split(item, candidate.point, radius);
    if (!split_item || split_item->places.size() < (candidate.radius ? 2U : 3U)) return false;
    double own_worst = 0;
    for (const Vec3& p : item.points) {
      own_worst = std::max(own_worst, std::abs(item.surface.signed_distance(p)));
    }
    // A vertex on a chord is no deeper than its middle; where no chord is known whole, not by much
    // more than the own fit shows.
    constexpr double kDeepest = 4;
    const double allowed = std::max(kDeepest * own_worst, sagitta(split_item->places, radius));
    if (split_item->deepest > allowed + exact_) return false;
    item.surface.point = candidate.point;
    item.surface.radius = radius;
    item.points = std::move(split_item->points);
    item.sigma = std::max(snap_.noise, rms_distance(item.surface, item.points));
    item.deviation.position = candidate.deviation;
    item.deviation.radius = item.sigma;
    return true;
  }

  std::vector<FitItem>& items_;
  const std::vector<Vec3>& directions_;
  const SnapRule& snap_;
  double exact_;
  Vec3 axis_ = Vec3::UnitZ();
};

}  // namespace

void settle_short_arcs(std::vector<FitItem>& items, const std::vector<Vec3>& directions,
                       const SnapRule& snap, double exact) {
  ArcSettler(items, directions, snap, exact).run();
}

}  // namespace hewn
