#include "core/fit/axis_lines.h"

#include <algorithm>
#include <numeric>

#include "core/fit/directions.h"
#include "core/fit/polygon_arcs.h"
#include "core/fit/round_values.h"
#include "core/fit/short_arcs.h"
#include "core/fit/snap_rule.h"

namespace hewn {
namespace {

struct AxisLine {
  int direction = 0;
  Vec3 point = Vec3::Zero();  ///< nearest to the origin
  double deviation = kInfinity;
  std::vector<int> items;
};

bool has_line(const FitItem& item) {
  return item.surface.kind == SurfaceKind::Cylinder || item.surface.kind == SurfaceKind::Cone ||
         item.surface.kind == SurfaceKind::Torus;
}

Vec3 across(const Vec3& p, const Vec3& direction) { return p - direction * direction.dot(p); }

class PositionSettler {
 public:
  PositionSettler(std::vector<FitItem>& items, const std::vector<Vec3>& directions, double diagonal,
                  double noise, const RegulariseOptions& options)
      : items_(items),
        directions_(directions),
        snap_(options, diagonal, noise),
        exact_(exact_reach(diagonal, noise)),
        options_(options) {}

  void run() {
    for (FitItem& item : items_) align(item);
    settle_polygon_arcs(items_, directions_, exact_, snap_.noise);
    settle_short_arcs(items_, directions_, snap_, exact_);
    find_lines();
    for (AxisLine& line : lines_) settle(line);
    for (FitItem& item : items_) settle_along(item);
  }

 private:
  double rounded(double value, double deviation) const {
    return options_.round_values ? round_value(value, snap_.tolerance(deviation)) : value;
  }

  /// Gives the item its cluster's direction and refits the rest.
  void align(FitItem& item) {
    Surface& s = item.surface;
    if (item.direction < 0) return;
    const Vec3& d = directions_[item.direction];
    const double sign = d.dot(s.axis) < 0 ? -1 : 1;
    if (s.kind == SurfaceKind::Plane) {
      s.axis = d;
      s.offset = d.dot(item.center);
    } else {
      if (s.kind == SurfaceKind::Cylinder) s.point += s.axis * s.axis.dot(item.center - s.point);
      s.axis = s.kind == SurfaceKind::Cone ? Vec3(d * sign) : d;
      FitSettings settings;
      settings.keep_axis = true;
      settings.min_decrease = 1e-9;
      refine_surface(s, {item.points}, settings);
    }
    const double rms = rms_distance(s, item.points);
    item.sigma = std::max(item.sigma, rms);
    item.deviation = fit_deviation(s, item.points, item.sigma, true);
  }

  void find_lines() {
    for (int i = 0; i < static_cast<int>(items_.size()); ++i) {
      const FitItem& item = items_[i];
      if (!has_line(item)) continue;
      const Vec3 p = across(item.surface.point, directions_[item.direction]);
      AxisLine* found = nullptr;
      for (AxisLine& line : lines_) {
        if (line.direction != item.direction) continue;
        const double distance = (line.point - p).norm();
        const double own = options_.round_deviations * (item.deviation.position + line.deviation);
        // Loosely determined axes may be further off.
        if (distance < std::clamp(own, snap_.reach, 2 * snap_.reach)) {
          found = &line;
          break;
        }
      }
      if (found == nullptr) {
        lines_.push_back({item.direction, p, item.deviation.position, {}});
        found = &lines_.back();
      } else if (item.deviation.position < 0.1 * found->deviation) {
        found->point = p;
        found->deviation = item.deviation.position;
      }
      found->items.push_back(i);
    }
  }

  void settle(AxisLine& line) {
    const Vec3& d = directions_[line.direction];
    if (has_reference(d)) {
      const Tangents f = reference_frame(d);
      line.point = f.u * rounded(f.u.dot(line.point), line.deviation) +
                   f.w * rounded(f.w.dot(line.point), line.deviation);
    }
    for (const int i : line.items) {
      Surface& s = items_[i].surface;
      const double shift = (across(s.point, d) - line.point).norm();
      if (s.kind == SurfaceKind::Cylinder) {
        s.point = line.point;
      } else {
        s.point = line.point + d * d.dot(s.point);
      }
      if (shift > snap_.noise) refit_radius(items_[i]);
    }
  }

  /// The mean radius about an axis that has moved.
  static void refit_radius(FitItem& item) {
    Surface& s = item.surface;
    if (s.kind != SurfaceKind::Cylinder) return;
    double sum = 0;
    for (const Vec3& p : item.points) sum += s.signed_distance(p);
    s.radius += sum / static_cast<double>(item.points.size());
  }

  /// Rounds what is measured along the direction, and free centres.
  void settle_along(FitItem& item) {
    Surface& s = item.surface;
    if (s.kind == SurfaceKind::Plane) {
      s.offset = rounded(s.offset, item.deviation.offset);
    } else if (s.kind == SurfaceKind::Sphere) {
      for (double& c : s.point) c = rounded(c, item.deviation.position);
    } else if (s.kind == SurfaceKind::Torus) {
      const Vec3& d = directions_[item.direction];
      const double t = d.dot(s.point);
      s.point += d * (rounded(t, item.deviation.position) - t);
    }
  }

  std::vector<FitItem>& items_;
  const std::vector<Vec3>& directions_;
  SnapRule snap_;
  double exact_;
  const RegulariseOptions& options_;
  std::vector<AxisLine> lines_;
};

/// A radius to settle.
struct Size {
  double* value;
  double tolerance;
};

}  // namespace

void settle_positions(std::vector<FitItem>& items, const std::vector<Vec3>& directions,
                      double diagonal, double noise, const RegulariseOptions& options) {
  PositionSettler(items, directions, diagonal, noise, options).run();
}

void settle_radii(std::vector<FitItem>& items, double diagonal, double noise,
                  const RegulariseOptions& options) {
  std::vector<Size> sizes;
  const SnapRule snap(options, diagonal, noise);
  for (FitItem& item : items) {
    Surface& s = item.surface;
    if (s.kind == SurfaceKind::Plane || s.kind == SurfaceKind::Cone) continue;
    sizes.push_back({&s.radius, snap.tolerance(item.deviation.radius)});
    if (s.kind == SurfaceKind::Torus) {
      sizes.push_back({&s.major_radius, snap.tolerance(item.deviation.major_radius)});
    }
  }
  std::stable_sort(sizes.begin(), sizes.end(),
                   [](const Size& a, const Size& b) { return a.tolerance < b.tolerance; });
  std::vector<Size> settled;
  for (Size& size : sizes) {
    const auto equal = std::find_if(settled.begin(), settled.end(), [&](const Size& other) {
      return std::abs(*other.value - *size.value) <= size.tolerance;
    });
    if (equal != settled.end()) {
      *size.value = *equal->value;
      continue;
    }
    if (options.round_values) *size.value = round_value(*size.value, size.tolerance);
    settled.push_back(size);
  }
}

}  // namespace hewn
