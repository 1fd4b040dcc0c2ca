#include "core/segment/coaxial.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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
/// Facets may turn away from the surface by this much more than before.
constexpr double kAsSmooth = 1.2;
constexpr double kSmallAngle = 0.01;  // radians

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

std::vector<Vec2> points_near(const Profile& line, const std::vector<Vec2>& points, double eps) {
  std::vector<Vec2> near;
  std::copy_if(points.begin(), points.end(), std::back_inserter(near),
               [&](const Vec2& p) { return line.distance(p) < eps; });
  return near;
}

/// Through as many of the points as lie on one line. Cost: O(points) after some thousand pairs.
Profile line_through(const std::vector<Vec2>& points, double eps) {
  const std::size_t step = points.size() / kMostTried + 1;
  std::vector<Vec2> on_line;
  for (std::size_t i = 0; i < points.size(); i += step) {
    for (std::size_t k = i + step; k < points.size(); k += step) {
      const Vec2 way = points[k] - points[i];
      if (way.norm() < kLeastLength * eps) continue;
      std::vector<Vec2> near = points_near({points[i], way.normalized()}, points, eps);
      if (near.size() > on_line.size()) on_line = std::move(near);
    }
  }
  return on_line.empty() ? Profile{} : fitted_line(on_line);
}

class Adoption {
 public:
  Adoption(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
           FacetGroups& found)
      : mesh_(mesh), fitter_(mesh, graph, tolerance), eps_(tolerance.eps), groups_(found.groups) {}

  void run() {
    std::vector<Surface> axes;
    std::vector<int> loose;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const GrownGroup& group = groups_[g];
      if (group.surface.kind == SurfaceKind::Plane || group.is_settled) continue;
      if (!fitter_.has_exact_corners(fitter_.evaluate(group.surface, group.facets))) {
        loose.push_back(static_cast<int>(g));
      } else if (has_axis(group.surface) && !has_same_axis(axes, group.surface, 2 * eps_)) {
        axes.push_back(group.surface);
      }
    }
    for (const Surface& axis : axes) adopt(axis, loose);
  }

 private:
  /// The loose groups that turn out to be exact about the axis are taken out of `loose`.
  void adopt(const Surface& axis, std::vector<int>& loose) {
    std::vector<std::pair<int, Profile>> pieces;
    std::erase_if(loose, [&](int g) {
      const Profile profile = line_through(profile_of(axis, groups_[g].facets), eps_);
      const auto surface = surface_about(axis, profile);
      if (!surface || !is_better(*surface, groups_[g])) return false;
      groups_[g].surface = *surface;
      groups_[g].is_settled = true;
      pieces.emplace_back(g, profile);
      return true;
    });
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for (std::size_t k = i + 1; k < pieces.size(); ++k) {
        if (is_same(axis, pieces[i].second, pieces[k])) unite(pieces[i].first, pieces[k].first);
      }
      refit(axis, groups_[pieces[i].first]);
    }
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
  bool is_better(const Surface& s, const GrownGroup& group) {
    const std::vector<int> corners = fitter_.corner_indices(group.facets);
    const std::size_t exact = count_exact(s, corners);
    if (corners.size() < kLeastCorners || !is_most(exact, corners.size())) return false;
    if (exact < count_exact(group.surface, corners)) return false;
    const FitQuality before = fitter_.evaluate(group.surface, group.facets);
    const FitQuality after = fitter_.evaluate(s, group.facets);
    return after.max_distance < kChordSlack * after.sagitta + eps_ &&
           after.max_angle_rad < kAsSmooth * before.max_angle_rad + kSmallAngle;
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
    return !points.empty() && is_most(points_near(line, points, eps_).size(), points.size());
  }

  /// The second group comes out empty.
  void unite(int whole, int piece) {
    std::vector<int>& facets = groups_[whole].facets;
    facets.insert(facets.end(), groups_[piece].facets.begin(), groups_[piece].facets.end());
    groups_[piece].facets.clear();
  }

  void refit(const Surface& axis, GrownGroup& whole) {
    if (whole.facets.empty()) return;
    std::sort(whole.facets.begin(), whole.facets.end());
    const auto s = surface_about(axis, line_through(profile_of(axis, whole.facets), eps_));
    if (s) whole.surface = *s;
  }

  const Mesh& mesh_;
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
