#include "core/segment/leftovers.h"

#include <algorithm>
#include <numeric>

namespace hewn {
namespace {

constexpr double kSliverArea = 1e-8;      // shares of the squared diagonal
constexpr double kSliverDistance = 1e-3;  // shares of the diagonal
constexpr double kPatchDistance = 5e-4;
constexpr double kDentDistance = 1e-3;  // for facets of less than
constexpr double kDentArea = 0.1;       // of the patch's largest facet
constexpr double kMaxTurn = 0.5;        // radians, across a rim inside a flat patch
constexpr double kMaxTilt = 0.06;       // radians, of a facet that is not small
constexpr double kSmallArea = 1e-5;     // may be tilted: its corners decide
constexpr double kMinSeedCosine = 0.99;
constexpr double kMainShare = 0.5;  // of the group's area

double area_of(const FacetGraph& graph, const GrownGroup& group) {
  double area = 0;
  for (const int f : group.facets) area += graph.facets[f].area;
  return area;
}

class PlaneCollector {
 public:
  PlaneCollector(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                 std::vector<int>& group_of_facet)
      : graph_(graph),
        tolerance_(tolerance),
        fitter_(mesh, graph, tolerance),
        group_of_(group_of_facet),
        stamp_of_(graph.facets.size(), 0) {}

  GrownGroup collect(int seed) {
    GrownGroup group;
    group.surface = fitter_.plane_of(seed);
    group.facets = {seed};
    for (int pass = 0; pass < 2; ++pass) {
      flood(seed, group);
      if (group.facets.size() > 1) fitter_.refine(group.surface, group.facets, {4, false, 0});
      if (group.surface.axis.dot(graph_.facets[seed].normal) < kMinSeedCosine) break;
    }
    // What is small must not tilt the one large facet that it joins.
    if (graph_.facets[seed].area >= kMainShare * area_of(graph_, group)) {
      group.surface = fitter_.plane_of(seed);
    }
    return group;
  }

 private:
  void flood(int seed, GrownGroup& group) {
    ++stamp_;
    group.facets.assign(1, seed);
    stamp_of_[seed] = stamp_;
    for (std::size_t i = 0; i < group.facets.size(); ++i) {
      for (const FacetNeighbor& n : graph_.neighbors(group.facets[i])) {
        if (group_of_[n.facet] >= 0 || stamp_of_[n.facet] == stamp_) continue;
        if (n.angle_rad > kMaxTurn || !lies_on(group.surface, n.facet, seed)) continue;
        stamp_of_[n.facet] = stamp_;
        group.facets.push_back(n.facet);
      }
    }
  }

  bool lies_on(const Surface& plane, int f, int seed) const {
    const Facet& facet = graph_.facets[f];
    const bool is_dent = facet.area < kDentArea * graph_.facets[seed].area;
    const double limit = (is_dent ? kDentDistance : kPatchDistance) * tolerance_.diagonal;
    if (fitter_.max_distance(plane, f) > limit) return false;
    return angle_between(facet.normal, plane.axis) <= kMaxTilt ||
           facet.area <= kSmallArea * tolerance_.diagonal * tolerance_.diagonal;
  }

  const FacetGraph& graph_;
  SurfaceTolerance tolerance_;
  FacetFitter fitter_;
  std::vector<int>& group_of_;
  std::vector<int> stamp_of_;
  int stamp_ = 0;
};

/// What the facets of a curved group have in common.
struct FacetShape {
  Surface surface;
  double sagitta = 0;
  double angle_rad = 0;
  double side = 1;
};

FacetShape shape_of(const GrownGroup& group, const FacetGraph& graph, const FacetFitter& fitter) {
  const FitQuality q = fitter.evaluate(group.surface, group.facets);
  double agreement = 0;
  for (const int f : group.facets) {
    const Facet& facet = graph.facets[f];
    agreement += facet.area * group.surface.gradient(facet.centroid).dot(facet.normal);
  }
  return {group.surface, q.sagitta, q.max_angle_rad, agreement < 0 ? -1.0 : 1.0};
}

/// Whether a facet is one of the tessellation: all corners within its depth, two of them exactly on
/// the surface, and a normal that agrees.
bool belongs(const FacetShape& shape, const Mesh& mesh, const FacetGraph& graph, int f,
             double eps) {
  const Facet& facet = graph.facets[f];
  const Surface& s = shape.surface;
  const double depth = std::abs(s.signed_distance(facet.centroid));
  if (depth > 1.2 * shape.sagitta + eps || depth < 0.05 * shape.sagitta) return false;
  const double cosine = shape.side * s.gradient(facet.centroid).dot(facet.normal);
  if (cosine < std::cos(1.2 * shape.angle_rad + 0.01)) return false;
  int exact = 0;
  for (const int v : graph.corners(f)) {
    const double d = std::abs(s.signed_distance(mesh.vertices[v]));
    if (d > 1.15 * shape.sagitta + 2 * eps) return false;
    exact += d < 2 * eps;
  }
  return exact >= 2;
}

constexpr double kPiecePlane = 0.01;  // of the mesh's area: larger planes are no pieces

/// Whether all facets of a group lie within the depth of a surface's own facets.
bool is_piece(const FacetShape& shape, double depth, const GrownGroup& group,
              const FacetGraph& graph, const FacetFitter& fitter) {
  return std::all_of(group.facets.begin(), group.facets.end(), [&](int f) {
    if (fitter.max_depth(shape.surface, f) > depth) return false;
    if (fitter.is_tiny(f)) return true;
    const Facet& facet = graph.facets[f];
    const double cosine = shape.side * shape.surface.gradient(facet.centroid).dot(facet.normal);
    return cosine >= std::cos(1.3 * shape.angle_rad + 0.02);
  });
}

constexpr double kSplinterArea = 1e-4;  // of the mesh's area: whole splinter groups
constexpr double kCrookedArea = 1e-3;   // of the mesh's area
constexpr double kMainArea = 1e-2;      // of the mesh's area: tells a direction of the design
constexpr double kAligned = 1e-3;       // radians, from a direction or from across it
constexpr std::size_t kCrookedFacets = 2;

/// Decides where splinter groups go.
class SplinterDissolver {
 public:
  SplinterDissolver(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                    FacetGroups& found)
      : mesh_(mesh),
        graph_(graph),
        tolerance_(tolerance),
        fitter_(mesh, graph, tolerance),
        groups_(found.groups),
        group_of_(found.group_of) {
    for (const GrownGroup& group : groups_) areas_.push_back(area_of(graph, group));
  }

  void run() {
    std::vector<int> order(groups_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return areas_[a] < areas_[b]; });
    collect_directions();
    for (const int g : order) {
      if (areas_[g] > kCrookedArea * mesh_.total_area) break;
      if (groups_[g].surface.kind != SurfaceKind::Plane) continue;
      if (areas_[g] <= kSplinterArea * mesh_.total_area) {
        dissolve(g, reach(), tolerance_.is_resampled);
      }
      if (is_crooked(g)) dissolve(g, kCrookedDistance * tolerance_.diagonal, true);
    }
  }

 private:
  void collect_directions() {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const bool tells = groups_[g].surface.kind != SurfaceKind::Sphere &&
                         areas_[g] > kMainArea * mesh_.total_area;
      if (tells) directions_.push_back(groups_[g].surface.axis);
    }
  }

  /// A plane of one or two triangles that has nothing to do with any direction of the design: where
  /// a modeller lost a vertex, a few triangles stretch to the next one. It goes where it is thin.
  bool is_crooked(int g) const {
    if (groups_[g].facets.empty() || groups_[g].facets.size() > kCrookedFacets) return false;
    const Vec3& normal = groups_[g].surface.axis;
    return std::none_of(directions_.begin(), directions_.end(), [&](const Vec3& d) {
      const double angle = unsigned_angle(normal, d);
      return angle < kAligned || angle > kPi / 2 - kAligned;
    });
  }

  /// Moves all facets to larger neighbours whose surfaces they lie within `limit` of, or none.
  void dissolve(int g, double limit, bool may_turn) {
    std::vector<int> targets;
    for (const int f : groups_[g].facets) {
      const int target = target_of(f, g, limit, may_turn ? kPi : 4 * graph_.normal_error_rad[f]);
      if (target < 0) return;
      targets.push_back(target);
    }
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const int f = groups_[g].facets[i];
      group_of_[f] = targets[i];
      groups_[targets[i]].facets.push_back(f);
      areas_[targets[i]] += graph_.facets[f].area;
    }
    groups_[g].facets.clear();
  }

  int target_of(int f, int own, double limit, double max_turn) const {
    int best = -1;
    double best_distance = limit;
    for (const FacetNeighbor& n : graph_.neighbors(f)) {
      const int g = group_of_[n.facet];
      if (g < 0 || g == own || areas_[g] <= areas_[own]) continue;
      const Surface& s = groups_[g].surface;
      const double distance = fitter_.max_depth(s, f);
      if (distance >= best_distance) continue;
      const double turn =
          unsigned_angle(s.gradient(graph_.facets[f].centroid), graph_.facets[f].normal);
      if (turn > max_turn) continue;
      best = g;
      best_distance = distance;
    }
    return best;
  }

  double reach() const {
    return tolerance_.is_resampled ? kStraddleDistance * tolerance_.diagonal
                                   : 2 * tolerance_.eps + 2 * tolerance_.noise;
  }

  static constexpr double kStraddleDistance = 4e-3;  // shares of the diagonal
  static constexpr double kCrookedDistance = 1e-3;

  const Mesh& mesh_;
  const FacetGraph& graph_;
  SurfaceTolerance tolerance_;
  FacetFitter fitter_;
  std::vector<GrownGroup>& groups_;
  std::vector<int>& group_of_;
  std::vector<double> areas_;
  std::vector<Vec3> directions_;
};

}  // namespace

void absorb_slivers(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                    FacetGroups& found) {
  const FacetFitter fitter(mesh, graph, tolerance);
  const double max_area = kSliverArea * tolerance.diagonal * tolerance.diagonal;
  for (int f = 0; f < graph.size(); ++f) {
    if (found.group_of[f] >= 0 || graph.facets[f].area >= max_area) continue;
    for (const FacetNeighbor& n : graph.neighbors(f)) {
      const int g = found.group_of[n.facet];
      if (g < 0) continue;
      if (fitter.max_distance(found.groups[g].surface, f) > kSliverDistance * tolerance.diagonal) {
        continue;
      }
      found.group_of[f] = g;
      found.groups[g].facets.push_back(f);
      break;
    }
  }
}

void adopt_facets(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                  FacetGroups& found, const RunContext& run) {
  const FacetFitter fitter(mesh, graph, tolerance);
  std::vector<FacetShape> shapes;
  for (const GrownGroup& group : found.groups) shapes.push_back(shape_of(group, graph, fitter));
  for (int f = 0; f < graph.size() && !run.is_cancelled(); ++f) {
    if (found.group_of[f] >= 0 || fitter.is_tiny(f)) continue;
    for (std::size_t g = 0; g < found.groups.size(); ++g) {
      if (shapes[g].sagitta < 2 * tolerance.eps) continue;
      if (!belongs(shapes[g], mesh, graph, f, tolerance.eps)) continue;
      found.group_of[f] = static_cast<int>(g);
      found.groups[g].facets.push_back(f);
      break;
    }
  }
}

void merge_pieces(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                  FacetGroups& found, const RunContext& run) {
  FacetFitter fitter(mesh, graph, tolerance);
  std::vector<double> areas;
  for (const GrownGroup& group : found.groups) areas.push_back(area_of(graph, group));
  std::vector<int> order(found.groups.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return areas[a] > areas[b]; });
  for (std::size_t i = 0; i < order.size() && !run.is_cancelled(); ++i) {
    GrownGroup& whole = found.groups[order[i]];
    if (whole.facets.empty() || whole.surface.kind == SurfaceKind::Plane) continue;
    const FacetShape shape = shape_of(whole, graph, fitter);
    const FitQuality q = fitter.evaluate(whole.surface, whole.facets);
    const double depth = 1.5 * std::max(q.max_distance, q.sagitta);
    bool has_grown = false;
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      GrownGroup& piece = found.groups[order[j]];
      const bool is_plane = piece.surface.kind == SurfaceKind::Plane;
      if (is_plane && areas[order[j]] > kPiecePlane * mesh.total_area) continue;
      if (piece.facets.empty() || !is_piece(shape, depth, piece, graph, fitter)) continue;
      for (const int f : piece.facets) found.group_of[f] = order[i];
      whole.facets.insert(whole.facets.end(), piece.facets.begin(), piece.facets.end());
      piece.facets.clear();
      has_grown = true;
    }
    if (has_grown && !whole.is_settled) fitter.refine(whole.surface, whole.facets, {8, false, 0});
  }
  found.drop_empty();
}

void dissolve_splinters(const Mesh& mesh, const FacetGraph& graph,
                        const SurfaceTolerance& tolerance, FacetGroups& found) {
  SplinterDissolver(mesh, graph, tolerance, found).run();
  found.drop_empty();
}

Result<void> plane_leftovers(const Mesh& mesh, const FacetGraph& graph,
                             const SurfaceTolerance& tolerance, FacetGroups& found,
                             const RunContext& run) {
  std::vector<int> order(graph.facets.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return graph.facets[a].area > graph.facets[b].area; });
  PlaneCollector collector(mesh, graph, tolerance, found.group_of);
  for (const int f : order) {
    if (run.is_cancelled()) return RunContext::cancelled();
    if (found.group_of[f] >= 0 || graph.facets[f].area <= 0) continue;
    GrownGroup group = collector.collect(f);
    found.add(std::move(group));
  }
  return {};
}

}  // namespace hewn
