#include "core/segment/scattered.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "core/segment/same_axis.h"

namespace hewn {
namespace {

constexpr double kAlong = 1e-4;  ///< sine of the angle between a plane and the axis, at most
constexpr std::size_t kLeastPlanes = 5;
constexpr std::size_t kLeastTurns = 3;  ///< different ones
constexpr int kLeastCorners = 4;        ///< that lie on the cylinder, not cut off by teeth
constexpr double kLeastHalfStep = 0.3 * kPi / 180;
constexpr double kMostHalfStep = 12 * kPi / 180;
constexpr double kOffStep = 0.04;  ///< of azimuths from multiples of the step, in steps
/// Of the number of sides from a whole one; the less the facets' depth says, the more.
constexpr double kOffSides = 0.05;

/// A planar group along an axis.
struct Side {
  double distance = 0;     ///< of the plane from the axis, along its normal
  double azimuth_rad = 0;  ///< of its normal
  int group = 0;
};

class Gathering {
 public:
  Gathering(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
            std::vector<GrownGroup>& groups)
      : mesh_(mesh), graph_(graph), groups_(groups), near_(2 * tolerance.eps) {}

  void run() {
    std::vector<Surface> axes;
    for (const GrownGroup& g : groups_) {
      if (is_ruled(g.surface.kind) && !has_same_axis(axes, g.surface, near_))
        axes.push_back(g.surface);
    }
    for (const Surface& axis : axes) gather_about(axis);
  }

 private:
  void gather_about(const Surface& axis) {
    std::vector<Side> sides = sides_along(axis);
    for (std::size_t begin = 0; begin < sides.size();) {
      std::size_t end = begin + 1;
      while (end < sides.size() && sides[end].distance - sides[end - 1].distance < near_) ++end;
      const std::span<Side> alike(sides.data() + begin, end - begin);
      if (const auto cylinder = cylinder_of(axis, alike)) unite(*cylinder, alike);
      begin = end;
    }
  }

  /// All planar groups parallel to the axis, by their distance.
  std::vector<Side> sides_along(const Surface& axis) const {
    const Tangents frame = tangents(axis.axis);
    std::vector<Side> sides;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const GrownGroup& group = groups_[g];
      if (group.surface.kind != SurfaceKind::Plane || group.facets.empty()) continue;
      const Facet& facet = graph_.facets[group.facets.front()];
      if (std::abs(facet.normal.dot(axis.axis)) > kAlong) continue;
      sides.push_back({facet.normal.dot(facet.centroid - axis.point),
                       std::atan2(facet.normal.dot(frame.w), facet.normal.dot(frame.u)),
                       static_cast<int>(g)});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::pair(a.distance, a.group) < std::pair(b.distance, b.group);
    });
    return sides;
  }

  /// The cylinder around the sides' corners, if they are what a regular tessellation leaves of it.
  std::optional<Surface> cylinder_of(const Surface& axis, std::span<const Side> sides) const {
    if (sides.size() < kLeastPlanes) return std::nullopt;
    Surface s;
    s.kind = SurfaceKind::Cylinder;
    s.axis = axis.axis;
    s.point = axis.point;
    std::vector<double> radii;
    for (const Side& side : sides) {
      for (const int f : groups_[side.group].facets) {
        for (const int v : graph_.corners(f)) {
          radii.push_back(s.axis.cross(mesh_.vertices[v] - s.point).norm());
        }
      }
    }
    s.radius = *std::max_element(radii.begin(), radii.end());
    const auto on_rim =
        std::count_if(radii.begin(), radii.end(), [&](double r) { return r > s.radius - near_; });
    const double apothem = std::abs(sides.front().distance);
    if (on_rim < kLeastCorners || !(apothem < s.radius)) return std::nullopt;
    const double half_step = std::acos(apothem / s.radius);
    if (half_step < kLeastHalfStep || half_step > kMostHalfStep) return std::nullopt;
    const double depth = s.radius - apothem;
    const double off_sides = kOffSides + kPi / half_step * near_ / (8 * depth);
    return is_regular(sides, kPi / half_step, off_sides) ? std::optional(s) : std::nullopt;
  }

  /// Whether the sides are some of `count`, about a whole number, around the axis. Slivers of one
  /// plane are alike, too, but do not turn.
  static bool is_regular(std::span<const Side> sides, double count, double off_sides) {
    if (std::abs(count - std::round(count)) > off_sides) return false;
    const double step = 2 * kPi / std::round(count);
    std::set<long> turns;
    for (const Side& side : sides) {
      const double steps = (side.azimuth_rad - sides.front().azimuth_rad) / step;
      if (std::abs(steps - std::round(steps)) > kOffStep) return false;
      turns.insert(std::lround(steps));
    }
    return turns.size() >= kLeastTurns;
  }

  /// The first group becomes the cylinder, the others come out empty.
  void unite(const Surface& cylinder, std::span<const Side> sides) {
    GrownGroup& whole = groups_[sides.front().group];
    for (const Side& side : sides.subspan(1)) FacetGroups::unite(whole, groups_[side.group]);
    whole.surface = cylinder;
    whole.is_settled = true;
  }

  const Mesh& mesh_;
  const FacetGraph& graph_;
  std::vector<GrownGroup>& groups_;
  double near_;
};

}  // namespace

void gather_scattered(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                      FacetGroups& found) {
  Gathering(mesh, graph, tolerance, found.groups).run();
  found.drop_empty();
}

}  // namespace hewn
