#include "core/segment/coaxial.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Eigenvalues>

#include "core/segment/same_axis.h"

namespace hewn {
namespace {

constexpr std::size_t kMostTried = 48;  ///< of a group's corners, two by two
/// Of the corners have to lie on the surface; the others may lie on chords, where facets were cut.
constexpr double kExactShare = 0.7;
constexpr std::size_t kLeastCorners = 6;
constexpr double kLeastLength = 20;   ///< of the profile, in times eps
constexpr double kLeastSlope = 0.02;  ///< below it is a cylinder
constexpr double kMostSlope = 30;     ///< beyond it is a plane

bool is_most(std::size_t count, std::size_t of_all) {
  return static_cast<double>(count) >= kExactShare * static_cast<double>(of_all);
}

/// A line in the half plane beside an axis: x along the axis, y away from it.
struct Profile {
  Vec2 middle = Vec2::Zero();
  Vec2 direction = Vec2::UnitX();

  double distance(const Vec2& p) const {
    return std::abs(direction.x() * (p - middle).y() - direction.y() * (p - middle).x());
  }
};

/// The line with the least squares of distances.
Profile fitted_line(const std::vector<Vec2>& points) {
  Profile line;
  for (const Vec2& p : points) line.middle += p / static_cast<double>(points.size());
  Eigen::Matrix2d moment = Eigen::Matrix2d::Zero();
  for (const Vec2& p : points) moment += (p - line.middle) * (p - line.middle).transpose();
  line.direction = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(moment).eigenvectors().col(1);
  return line;
}

std::size_t count_near(const Profile& line, const std::vector<Vec2>& points, double eps) {
  return static_cast<std::size_t>(std::count_if(
      points.begin(), points.end(), [&](const Vec2& p) { return line.distance(p) < eps; }));
}

/// Through as many of the points as lie on one line. Cost: O(points) after some thousand pairs.
Profile line_through(std::vector<Vec2> points, double eps) {
  const std::size_t step = points.size() / kMostTried + 1;
  Profile best;
  std::size_t most = 0;
  for (std::size_t i = 0; i < points.size(); i += step) {
    for (std::size_t k = i + step; k < points.size(); k += step) {
      const Vec2 way = points[k] - points[i];
      if (way.norm() < kLeastLength * eps) continue;
      const Profile line{points[i], way.normalized()};
      const std::size_t count = count_near(line, points, eps);
      if (count <= most) continue;
      most = count;
      best = line;
    }
  }
  if (most == 0) return best;
  std::erase_if(points, [&](const Vec2& p) { return !(best.distance(p) < eps); });
  return fitted_line(points);
}

class Adoption {
 public:
  Adoption(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
           FacetGroups& found)
      : mesh_(mesh),
        graph_(graph),
        fitter_(mesh, graph, tolerance),
        eps_(tolerance.eps),
        groups_(found.groups) {}

  void run() {
    std::vector<Surface> axes;
    std::vector<Loose> loose;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const GrownGroup& group = groups_[g];
      if (group.surface.kind == SurfaceKind::Plane || group.is_settled) continue;
      const FitQuality quality = fitter_.evaluate(group.surface, group.facets);
      if (!fitter_.has_exact_corners(quality)) {
        loose.push_back({static_cast<int>(g), quality.angle_as_smooth()});
      } else if (is_ruled(group.surface.kind) && !has_same_axis(axes, group.surface, 2 * eps_)) {
        axes.push_back(group.surface);
      }
    }
    for (const Surface& axis : axes) adopt(axis, loose);
  }

 private:
  /// A group whose corners are not exact, and how far its facets may turn from another surface.
  struct Loose {
    int group = 0;
    double most_turn_rad = 0;
  };

  /// The loose groups that turn out to be exact about the axis are taken out of `loose`.
  void adopt(const Surface& axis, std::vector<Loose>& loose) {
    std::vector<std::pair<int, Profile>> pieces;
    std::erase_if(loose, [&](const Loose& l) {
      const int g = l.group;
      if (!may_turn_about(axis, l)) return false;
      const Profile profile = line_through(profile_of(axis, groups_[g].facets), eps_);
      const auto surface = surface_about(axis, profile);
      if (!surface || !is_better(*surface, l)) return false;
      groups_[g].surface = *surface;
      groups_[g].is_settled = true;
      pieces.emplace_back(g, profile);
      return true;
    });
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for (std::size_t k = i + 1; k < pieces.size(); ++k) {
        if (!is_same(axis, pieces[i].second, pieces[k])) continue;
        FacetGroups::unite(groups_[pieces[i].first], groups_[pieces[k].first]);
      }
      refit(axis, groups_[pieces[i].first]);
    }
  }

  /// Whether all facets face the axis as much as they would on any surface about it: a quick look
  /// before corners are tried two by two.
  bool may_turn_about(const Surface& axis, const Loose& loose) const {
    const double most_aside = std::sin(std::min(loose.most_turn_rad, kPi / 2));
    const std::vector<int>& facets = groups_[loose.group].facets;
    return std::all_of(facets.begin(), facets.end(), [&](int f) {
      const Facet& facet = graph_.facets[f];
      const Vec3 aside = axis.axis.cross(facet.centroid - axis.point);
      return std::abs(facet.normal.dot(aside)) <= most_aside * aside.norm();
    });
  }

  std::vector<Vec2> profile_of(const Surface& axis, std::span<const int> facets) {
    std::vector<Vec2> points;
    for (const int v : fitter_.corner_indices(facets)) {
      const Vec3 d = mesh_.vertices[v] - axis.point;
      const double height = axis.axis.dot(d);
      points.emplace_back(height, (d - height * axis.axis).norm());
    }
    return points;
  }

  std::optional<Surface> surface_about(const Surface& axis, const Profile& profile) const {
    Surface s;
    s.axis = axis.axis;
    s.point = axis.point;
    const double slope = profile.direction.y() / profile.direction.x();
    if (!(std::abs(slope) < kMostSlope)) return std::nullopt;
    if (std::abs(slope) < kLeastSlope) {
      s.kind = SurfaceKind::Cylinder;
      s.radius = profile.middle.y();
      return s;
    }
    s.kind = SurfaceKind::Cone;
    s.point += axis.axis * (profile.middle.x() - profile.middle.y() / slope);
    if (slope < 0) s.axis = -s.axis;
    s.half_angle_rad = std::atan(std::abs(slope));
    return s;
  }

  /// Whether most corners lie on the surface, as many as on the group's own, and the others no
  /// deeper than on the facets' chords.
  bool is_better(const Surface& s, const Loose& loose) {
    const GrownGroup& group = groups_[loose.group];
    const std::vector<int> corners = fitter_.corner_indices(group.facets);
    const std::size_t exact = count_exact(s, corners);
    if (corners.size() < kLeastCorners || !is_most(exact, corners.size())) return false;
    if (exact < count_exact(group.surface, corners)) return false;
    const FitQuality after = fitter_.evaluate(s, group.facets);
    return after.max_distance < kChordSlack * after.sagitta + eps_ &&
           after.max_angle_rad < loose.most_turn_rad;
  }

  std::size_t count_exact(const Surface& s, const std::vector<int>& corners) const {
    const SurfaceField field(s);
    return static_cast<std::size_t>(std::count_if(corners.begin(), corners.end(), [&](int v) {
      return std::abs(field.signed_distance(mesh_.vertices[v])) < eps_;
    }));
  }

  /// Whether the other piece lies on the line, too.
  bool is_same(const Surface& axis, const Profile& line, const std::pair<int, Profile>& other) {
    const std::vector<Vec2> points = profile_of(axis, groups_[other.first].facets);
    return !points.empty() && is_most(count_near(line, points, eps_), points.size());
  }

  void refit(const Surface& axis, GrownGroup& whole) {
    if (whole.facets.empty()) return;
    const auto s = surface_about(axis, line_through(profile_of(axis, whole.facets), eps_));
    if (s) whole.surface = *s;
  }

  const Mesh& mesh_;
  const FacetGraph& graph_;
  FacetFitter fitter_;
  double eps_;
  std::vector<GrownGroup>& groups_;
};

}  // namespace

void adopt_axes(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                FacetGroups& found) {
  // Its corners lie anywhere on facets.
  if (tolerance.is_resampled) return;
  Adoption(mesh, graph, tolerance, found).run();
  found.drop_empty();
}

}  // namespace hewn
