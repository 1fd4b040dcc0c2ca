#include "core/sample/bars.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/mesh/edge_use.h"

namespace hewn {
namespace {

constexpr double kMostOblique = 0.87;  // cosine of the angle between two sides
constexpr double kLeastLength = 1;     // of a bar, against its wider sides
constexpr double kInset = 0.02;        // of the thickness: from the sides
constexpr int kAround = 6;             // points around an axis
constexpr double kOpenSide = 0.35;     // mean of unit vectors to the sides: larger for an arc

/// The common edge of two sides of a bar.
struct BarEdge {
  int side = -1;    ///< group
  int across = -1;  ///< group
  double lo = kInfinity, hi = -kInfinity;
  Vec3 point = Vec3::Zero();  ///< on it
};

class BarFinder {
 public:
  BarFinder(const SampleSpace& space, const SurfaceSet& surfaces)
      : space_(space), surfaces_(surfaces) {}

  std::vector<Bar> find() {
    collect_edges();
    std::vector<Bar> bars;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      for (std::size_t j = i + 1; j < edges_.size() && edges_[j].across == edges_[i].across; ++j) {
        add_bar(edges_[i], edges_[j], bars);
      }
    }
    for (int g = 0; g < static_cast<int>(space_.segmentation->groups.size()); ++g) {
      add_round_bar(g, bars);
    }
    return bars;
  }

 private:
  using GroupPair = std::pair<int, int>;

  const FaceGroup& group(int g) const {
    return space_.segmentation->groups[static_cast<std::size_t>(g)];
  }

  /// The plane of a group that may be the side of a bar; null for others.
  const Halfspace* plane_of(int g) const {
    if (g < 0 || !space_.label->owns_group(g)) return nullptr;
    const int h = surfaces_.halfspace_of_group[static_cast<std::size_t>(g)];
    if (h < 0) return nullptr;
    const Halfspace& plane = surfaces_.halfspaces[static_cast<std::size_t>(h)];
    return plane.surface.kind == SurfaceKind::Plane ? &plane : nullptr;
  }

  /// Out of the solid, exactly along one of the part's directions.
  Vec3 outward(int g) const {
    const Vec3& axis = plane_of(g)->surface.axis;
    const Vec3 facing = group(g).side * group(g).surface.axis;
    return axis.dot(facing) < 0 ? Vec3(-axis) : axis;
  }

  /// Outer edges between planes, seen from either of them.
  void collect_edges() {
    const Mesh& mesh = space_.mesh();
    const std::vector<EdgeSide> sides = sorted_sides(mesh.triangles);
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
      if (edge.size() != 2) return;
      const auto& group_of = space_.segmentation->group_of_triangle;
      const int a = group_of[static_cast<std::size_t>(edge[0].triangle())];
      const int b = group_of[static_cast<std::size_t>(edge[1].triangle())];
      if (a == b || !plane_of(a) || !plane_of(b)) return;
      const Vec3 p = mesh.vertices[static_cast<std::size_t>(edge[0].low())];
      const Vec3 q = mesh.vertices[static_cast<std::size_t>(edge[0].high())];
      if (!is_outer_edge(edge[0].triangle(), a, edge[1].triangle(), b)) return;
      for (const GroupPair& pair : {GroupPair{a, b}, GroupPair{b, a}}) {
        BarEdge& e = by_groups_[pair];
        const Vec3 along = direction(pair.first, pair.second);
        e.side = pair.first;
        e.across = pair.second;
        e.point = p;
        e.lo = std::min({e.lo, along.dot(p), along.dot(q)});
        e.hi = std::max({e.hi, along.dot(p), along.dot(q)});
      }
    });
    for (const auto& [pair, edge] : by_groups_) edges_.push_back(edge);
    std::stable_sort(edges_.begin(), edges_.end(),
                     [](const BarEdge& e, const BarEdge& f) { return e.across < f.across; });
  }

  /// Along the edge of two groups, the same for any order of them.
  Vec3 direction(int a, int b) const {
    const Vec3 d = outward(std::min(a, b)).cross(outward(std::max(a, b))).normalized();
    const Vec3 size = d.cwiseAbs();
    Eigen::Index largest = 0;
    size.maxCoeff(&largest);
    return d[largest] < 0 ? Vec3(-d) : d;
  }

  /// Whether the planes meet at an angle that is not too sharp and the solid lies within both.
  bool is_outer_edge(int triangle_a, int a, int triangle_b, int b) const {
    if (std::abs(outward(a).dot(outward(b))) > kMostOblique) return false;
    const Mesh& mesh = space_.mesh();
    const Vec3 way = mesh.centroid(triangle_b) - mesh.centroid(triangle_a);
    return outward(a).dot(way) < 0 && outward(b).dot(way) > 0;
  }

  bool are_opposite(int a, int b) const {
    return (outward(a) + outward(b)).norm() < kSameBarDirection;
  }

  /// Between the side across both and the one opposite to it, which must be across both, too; 0
  /// when there is none.
  double width(const BarEdge& e, const BarEdge& f) const {
    for (const BarEdge& other : edges_) {
      if (other.side != e.side || !are_opposite(other.across, e.across)) continue;
      if (by_groups_.contains({f.side, other.across})) {
        return outward(e.across).dot(e.point - other.point);
      }
    }
    return 0;
  }

  void add_bar(const BarEdge& e, const BarEdge& f, std::vector<Bar>& bars) const {
    if (!are_opposite(e.side, f.side)) return;
    const Vec3 out = outward(e.side);
    Bar bar;
    bar.along = direction(e.side, e.across);
    const bool is_turned = bar.along.dot(direction(f.side, f.across)) < 0;
    bar.lo = std::min(e.lo, is_turned ? -f.hi : f.lo);
    bar.hi = std::max(e.hi, is_turned ? -f.lo : f.hi);
    bar.thickness = out.dot(e.point - f.point);
    const double across = width(e, f);
    if (std::min(bar.thickness, across) <= 0) return;
    if (bar.hi - bar.lo < kLeastLength * std::max(bar.thickness, across)) return;
    const Vec3 down = -kInset * bar.thickness * outward(e.across);
    bar.low_rim = {Vec3(e.point + down - kInset * bar.thickness * out),
                   Vec3(f.point + down + kInset * bar.thickness * out)};
    bar.high_rim = bar.low_rim;
    bars.push_back(bar);
  }

  /// A rod or a drilled hole that goes all the way round its axis.
  void add_round_bar(int g, std::vector<Bar>& bars) const {
    const int h = surfaces_.halfspace_of_group[static_cast<std::size_t>(g)];
    if (h < 0 || !space_.label->owns_group(g)) return;
    const Surface& s = surfaces_.halfspaces[static_cast<std::size_t>(h)].surface;
    if (s.kind != SurfaceKind::Cylinder && s.kind != SurfaceKind::Cone) return;
    Bar bar;
    bar.along = s.axis;
    bar.lo = kInfinity;
    bar.hi = -kInfinity;
    Vec3 mean = Vec3::Zero();
    const Mesh& mesh = space_.mesh();
    for (const int t : group(g).triangles) {
      const auto i = static_cast<std::size_t>(t);
      const Vec3 from_axis = mesh.centroid(t) - s.point;
      const Vec3 side = from_axis - s.axis * s.axis.dot(from_axis);
      mean += mesh.areas[i] / group(g).area * side.normalized();
      for (int k = 0; k < 3; ++k) {
        bar.lo = std::min(bar.lo, s.axis.dot(mesh.corner(t, k)));
        bar.hi = std::max(bar.hi, s.axis.dot(mesh.corner(t, k)));
      }
    }
    if (mean.norm() > kOpenSide) return;
    bar.label = group(g).side > 0 ? Label::Inside : Label::Outside;
    bar.thickness = 2 * std::min(radius_at(s, bar.lo), radius_at(s, bar.hi));
    if (bar.thickness <= 0) return;
    bar.low_rim = rim(s, bar.lo);
    bar.high_rim = rim(s, bar.hi);
    bars.push_back(bar);
  }

  static double radius_at(const Surface& s, double along) {
    if (s.kind == SurfaceKind::Cylinder) return s.radius;
    return (along - s.axis.dot(s.point)) * std::tan(s.half_angle_rad);
  }

  static std::vector<Vec3> rim(const Surface& s, double along) {
    const Tangents t = tangents(s.axis);
    const Vec3 center = s.point + (along - s.axis.dot(s.point)) * s.axis;
    std::vector<Vec3> points;
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2 * kPi * k / kAround;
      const Vec3 outward = std::cos(angle) * t.u + std::sin(angle) * t.w;
      points.emplace_back(center + (1 - 2 * kInset) * radius_at(s, along) * outward);
    }
    return points;
  }

  const SampleSpace& space_;
  const SurfaceSet& surfaces_;
  std::map<GroupPair, BarEdge> by_groups_;
  std::vector<BarEdge> edges_;  ///< by the side across
};

}  // namespace

std::vector<Bar> find_bars(const SampleSpace& space, const SurfaceSet& surfaces) {
  return BarFinder(space, surfaces).find();
}

}  // namespace hewn
