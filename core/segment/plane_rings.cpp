#include "core/segment/plane_rings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <Eigen/Eigenvalues>

namespace hewn {
namespace {

constexpr std::size_t kFlatTriangles = 2;    // a facet with fewer lies across an edge
constexpr std::size_t kBridgeTriangles = 4;  // and with fewer than these it may
constexpr int kMaxBridge = 2;                // facets across edges between two flat ones
constexpr double kMinStep = 0.02;            // radians between the planes of one cylinder
constexpr double kAcross = 0.01;             // radians, of a plane from the axis
constexpr double kSteady = 0.3;              // largest difference of steps, against the seed's
constexpr double kRegular = 0.02;            // spread of steps, against the step
constexpr double kTangent = 0.15;            // planes off the inscribed circle, against the depth
constexpr double kMaxDepth = 4e-3;           // share of the diagonal
constexpr std::size_t kMinPlanes = 4;
constexpr std::size_t kMaxLinks = 24;  // of one facet, nearest first

/// Another flat facet that a smooth bend joins to this one.
struct Link {
  int facet = 0;
  double turn_rad = 0;
};

/// The circle that all planes of a regular tessellation touch, across `axis`.
struct Ring {
  Vec3 axis = Vec3::Zero();
  Vec3 center = Vec3::Zero();
  double radius = 0;  ///< inscribed; negative when the normals point inwards
  double step_rad = 0;
  bool is_regular = false;  ///< all steps are the same
  std::vector<int> facets;

  double circumscribed() const { return std::abs(radius) / std::cos(step_rad / 2); }
  double depth() const { return circumscribed() - std::abs(radius); }
};

class RingFinder {
 public:
  RingFinder(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
             double smooth_rad, FacetGroups& found)
      : mesh_(mesh),
        graph_(graph),
        tolerance_(tolerance),
        smooth_rad_(smooth_rad),
        groups_(found.groups),
        group_of_(found.group_of),
        links_(graph.facets.size()),
        stamp_of_(graph.facets.size(), 0) {}

  Result<void> run(const RunContext& run) {
    for (int f = 0; f < graph_.size(); ++f) {
      if (run.is_cancelled()) return RunContext::cancelled();
      if (is_flat(f)) find_links(f);
    }
    std::vector<int> order(graph_.facets.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return graph_.facets[a].area > graph_.facets[b].area; });
    for (const int f : order) {
      if (run.is_cancelled()) return RunContext::cancelled();
      if (group_of_[f] >= 0 || links_[f].size() < 2) continue;
      if (std::optional<Ring> ring = best_ring(f)) take(*ring);
    }
    return {};
  }

 private:
  bool is_flat(int f) const { return graph_.facets[f].triangles.size() >= kFlatTriangles; }

  /// Flat facets that are reached directly or over a few others that are not flat.
  void find_links(int from) {
    ++stamp_;
    stamp_of_[from] = stamp_;
    std::vector<int> ring = {from};
    for (int hop = 0; hop <= kMaxBridge && !ring.empty(); ++hop) {
      std::vector<int> next;
      for (const int f : ring) {
        for (const FacetNeighbor& n : graph_.neighbors(f)) {
          if (stamp_of_[n.facet] == stamp_) continue;
          stamp_of_[n.facet] = stamp_;
          const Facet& other = graph_.facets[n.facet];
          if (other.normal.isZero()) continue;
          const double turn = angle_between(graph_.facets[from].normal, other.normal);
          if (turn > smooth_rad_ * 1.1) continue;
          if (other.triangles.size() < kBridgeTriangles) next.push_back(n.facet);
          if (is_flat(n.facet) && turn > kMinStep) links_[from].push_back({n.facet, turn});
        }
      }
      ring = std::move(next);
    }
    if (links_[from].size() > kMaxLinks) links_[from].resize(kMaxLinks);
  }

  /// Tries the facet with each pair of its neighbours that bends on with the same step.
  std::optional<Ring> best_ring(int middle) {
    std::optional<Ring> best;
    double best_area = 0;
    const std::vector<Link>& links = links_[middle];
    for (std::size_t i = 0; i < links.size(); ++i) {
      for (std::size_t j = i + 1; j < links.size(); ++j) {
        std::optional<Ring> ring = seed_ring(middle, links[i], links[j]);
        if (!ring || !grow(*ring)) continue;
        double area = 0;
        for (const int f : ring->facets) area += graph_.facets[f].area;
        if (area <= best_area) continue;
        best_area = area;
        best = std::move(ring);
      }
    }
    return best;
  }

  std::optional<Ring> seed_ring(int middle, const Link& a, const Link& b) const {
    if (group_of_[a.facet] >= 0 || group_of_[b.facet] >= 0) return std::nullopt;
    if (std::abs(a.turn_rad - b.turn_rad) > kSteady * a.turn_rad) return std::nullopt;
    const Vec3& n = graph_.facets[middle].normal;
    const Vec3& before = graph_.facets[a.facet].normal;
    const Vec3& after = graph_.facets[b.facet].normal;
    Ring ring;
    ring.axis = before.cross(after);
    // On the same side of the middle one, or twice the same: no bend.
    if (ring.axis.norm() < std::sin(1.5 * a.turn_rad)) return std::nullopt;
    ring.axis.normalize();
    if (std::abs(ring.axis.dot(n)) > kAcross) return std::nullopt;
    ring.step_rad = (a.turn_rad + b.turn_rad) / 2;
    ring.facets = {middle, a.facet, b.facet};
    std::sort(ring.facets.begin(), ring.facets.end());
    if (!fit(ring)) return std::nullopt;
    return ring;
  }

  /// Least squares: each plane's n . center + radius = its offset.
  bool fit(Ring& ring) const {
    const Tangents t = tangents(ring.axis);
    Mat3 a = Mat3::Zero();
    Vec3 b = Vec3::Zero();
    const Vec3 origin = graph_.facets[ring.facets.front()].centroid;
    for (const int f : ring.facets) {
      const Facet& facet = graph_.facets[f];
      const Vec3 row(facet.normal.dot(t.u), facet.normal.dot(t.w), 1);
      a += row * row.transpose();
      b += row * facet.normal.dot(facet.centroid - origin);
    }
    const Vec3 x = a.ldlt().solve(b);
    if (!x.allFinite()) return false;
    ring.center = origin + t.u * x[0] + t.w * x[1];
    ring.radius = x[2];
    const double depth = ring.depth();
    return depth > 2 * tolerance_.eps && depth < kMaxDepth * tolerance_.diagonal;
  }

  double miss(const Ring& ring, int f) const {
    const Facet& facet = graph_.facets[f];
    return std::abs(facet.normal.dot(facet.centroid - ring.center) - ring.radius);
  }

  double tangent_limit(const Ring& ring) const {
    return std::max(kTangent * ring.depth(), tolerance_.eps);
  }

  /// Follows links while the planes touch the circle. False when too few do.
  bool grow(Ring& ring) {
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
      const std::size_t before = ring.facets.size();
      flood(ring);
      if (ring.facets.size() < kMinPlanes || !improve_axis(ring) || !fit(ring)) return false;
      if (round > 0 && ring.facets.size() <= before) break;
    }
    // A wall that runs on from a slot's round end touches the circle, too.
    const Surface s = surface_of(ring);
    std::erase_if(ring.facets, [&](int f) { return !lies_within(ring, s, f); });
    return distinct_planes(ring) >= kMinPlanes &&
           std::all_of(ring.facets.begin(), ring.facets.end(),
                       [&](int f) { return miss(ring, f) < tangent_limit(ring); });
  }

  void flood(Ring& ring) {
    ++stamp_;
    std::vector<int> queue;
    for (const int f : ring.facets) {
      if (miss(ring, f) >= tangent_limit(ring)) continue;
      stamp_of_[f] = stamp_;
      queue.push_back(f);
    }
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const Link& link : links_[queue[i]]) {
        if (stamp_of_[link.facet] == stamp_ || group_of_[link.facet] >= 0) continue;
        if (std::abs(graph_.facets[link.facet].normal.dot(ring.axis)) > kAcross) continue;
        if (miss(ring, link.facet) >= tangent_limit(ring)) continue;
        stamp_of_[link.facet] = stamp_;
        queue.push_back(link.facet);
      }
    }
    std::sort(queue.begin(), queue.end());
    ring.facets = std::move(queue);
  }

  /// The direction most across all normals; the median step between linked planes.
  bool improve_axis(Ring& ring) const {
    Mat3 moment = Mat3::Zero();
    for (const int f : ring.facets) {
      moment += graph_.facets[f].normal * graph_.facets[f].normal.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(moment);
    ring.axis = solver.eigenvectors().col(0);
    std::vector<double> steps;
    for (const int f : ring.facets) {
      double nearest = kInfinity;
      for (const Link& link : links_[f]) {
        if (!std::binary_search(ring.facets.begin(), ring.facets.end(), link.facet)) continue;
        nearest = std::min(nearest, link.turn_rad);
      }
      if (nearest < kInfinity) steps.push_back(nearest);
    }
    if (steps.size() < kMinPlanes) return false;
    std::sort(steps.begin(), steps.end());
    ring.step_rad = steps[steps.size() / 2];
    const double spread = steps[steps.size() * 3 / 4] - steps[steps.size() / 4];
    ring.is_regular = spread < kRegular * ring.step_rad;
    return true;
  }

  std::size_t distinct_planes(const Ring& ring) const {
    std::vector<Vec3> seen;
    for (const int f : ring.facets) {
      const Vec3& n = graph_.facets[f].normal;
      const bool is_new = std::none_of(seen.begin(), seen.end(), [&](const Vec3& other) {
        return angle_between(other, n) < ring.step_rad / 2;
      });
      if (is_new) seen.push_back(n);
      if (seen.size() >= kMinPlanes) break;
    }
    return seen.size();
  }

  /// Makes the ring a group, with the facets across its edges.
  void take(const Ring& ring) {
    GrownGroup group;
    group.surface = surface_of(ring);
    group.facets = ring.facets;
    group.is_settled = ring.is_regular;
    const int id = static_cast<int>(groups_.size());
    for (const int f : group.facets) group_of_[f] = id;
    for (std::size_t i = 0; i < group.facets.size(); ++i) {
      for (const FacetNeighbor& n : graph_.neighbors(group.facets[i])) {
        if (group_of_[n.facet] >= 0 || !lies_within(ring, group.surface, n.facet)) continue;
        group_of_[n.facet] = id;
        group.facets.push_back(n.facet);
      }
    }
    groups_.push_back(std::move(group));
  }

  static Surface surface_of(const Ring& ring) {
    Surface s;
    s.kind = SurfaceKind::Cylinder;
    s.axis = ring.axis;
    s.point = ring.center;
    s.radius = ring.circumscribed();
    return s;
  }

  /// Between the inscribed and the circumscribed circle, and facing the right way.
  bool lies_within(const Ring& ring, const Surface& s, int f) const {
    const double slack = tangent_limit(ring);
    for (const int v : graph_.vertices(f)) {
      const double d = s.signed_distance(mesh_.vertices[v]);
      if (d > slack || d < -ring.depth() - slack) return false;
    }
    const Facet& facet = graph_.facets[f];
    if (s.signed_distance(facet.centroid) < -ring.depth() - slack) return false;
    if (facet.normal.isZero()) return true;
    const double side = ring.radius < 0 ? -1 : 1;
    return side * s.gradient(facet.centroid).dot(facet.normal) > std::cos(ring.step_rad);
  }

  const Mesh& mesh_;
  const FacetGraph& graph_;
  SurfaceTolerance tolerance_;
  double smooth_rad_;
  std::vector<GrownGroup>& groups_;
  std::vector<int>& group_of_;
  std::vector<std::vector<Link>> links_;
  std::vector<int> stamp_of_;
  int stamp_ = 0;
};

}  // namespace

Result<void> take_plane_rings(const Mesh& mesh, const FacetGraph& graph,
                              const SurfaceTolerance& tolerance, double smooth_rad,
                              FacetGroups& found, const RunContext& run) {
  return RingFinder(mesh, graph, tolerance, smooth_rad, found).run(run);
}

}  // namespace hewn
