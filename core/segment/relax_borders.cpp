#include "core/segment/relax_borders.h"

#include <algorithm>

#include "core/fit/gauss_newton.h"

namespace hewn {
namespace {

constexpr int kRounds = 4;
constexpr double kBetter = 0.5;     // of the own distance: what a facet gains by moving
constexpr double kMaxTurn = 0.1;    // radians, of a facet from the surface that it moves to
constexpr double kMainFacet = 0.3;  // of a plane's area: the facet that tells where it lies
constexpr std::size_t kPointsPerParameter = 3;
constexpr std::size_t kMaxPoints = 2000;

class BorderRelaxer {
 public:
  BorderRelaxer(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                FacetGroups& found)
      : graph_(graph),
        tolerance_(tolerance),
        fitter_(mesh, graph, tolerance),
        groups_(found.groups),
        group_of_(found.group_of) {}

  void run(const RunContext& run) {
    for (int round = 0; round < kRounds && !run.is_cancelled(); ++round) {
      for (GrownGroup& group : groups_) {
        if (run.is_cancelled()) return;
        refit(group);
      }
      if (!reassign()) break;
    }
  }

 private:
  void refit(GrownGroup& group) {
    if (group.facets.empty() || group.is_settled) return;
    if (group.surface.kind == SurfaceKind::Plane) {
      refit_plane(group);
      return;
    }
    std::vector<int> inner;
    for (const int f : group.facets) {
      if (is_inside(f)) inner.push_back(f);
    }
    const std::vector<Vec3> points = fitter_.corner_points(inner, kMaxPoints);
    const auto parameters = static_cast<std::size_t>(parameter_count(group.surface.kind));
    if (points.size() < kPointsPerParameter * parameters) return;
    // Vertices lie anywhere in the depth of the facets that were cut up; squares below it, absolute
    // distances beyond.
    Surface s = group.surface;
    FitSettings settings;
    settings.max_iterations = 12;
    for (int pass = 0; pass < 2; ++pass) {
      settings.robust_scale = std::max(0.1 * tolerance_.eps, 2 * median_distance(s, points));
      if (!refine_surface(s, {points}, settings)) return;
    }
    if (median_distance(s, points) < median_distance(group.surface, points)) group.surface = s;
  }

  /// One large flat facet says where the plane lies; triangles across its rim do not.
  void refit_plane(GrownGroup& group) {
    double area = 0;
    int largest = group.facets.front();
    for (const int f : group.facets) {
      area += graph_.facets[f].area;
      if (graph_.facets[f].area > graph_.facets[largest].area) largest = f;
    }
    if (graph_.facets[largest].area > kMainFacet * area) {
      group.surface = fitter_.plane_of(largest);
    }
  }

  bool is_inside(int f) const {
    const auto neighbors = graph_.neighbors(f);
    return std::all_of(neighbors.begin(), neighbors.end(),
                       [&](const FacetNeighbor& n) { return group_of_[n.facet] == group_of_[f]; });
  }

  static double median_distance(const Surface& s, std::span<const Vec3> points) {
    std::vector<double> distances;
    for (const Vec3& p : points) distances.push_back(std::abs(s.signed_distance(p)));
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle;
  }

  /// Moves facets until none gains; true when any moved.
  bool reassign() {
    bool has_moved = false;
    for (int f = 0; f < graph_.size(); ++f) {
      const int own = group_of_[f];
      if (own < 0 || groups_[own].is_settled || is_main_facet(f)) continue;
      const int target = better_neighbor(f);
      if (target < 0) continue;
      group_of_[f] = target;
      has_moved = true;
    }
    if (!has_moved) return false;
    for (GrownGroup& group : groups_) group.facets.clear();
    for (int f = 0; f < graph_.size(); ++f) {
      if (group_of_[f] >= 0) groups_[group_of_[f]].facets.push_back(f);
    }
    return true;
  }

  /// The facet that a plane's place was taken from stays with it.
  bool is_main_facet(int f) const {
    const GrownGroup& group = groups_[group_of_[f]];
    return group.surface.kind == SurfaceKind::Plane &&
           fitter_.max_depth(group.surface, f) < tolerance_.eps;
  }

  int better_neighbor(int f) const {
    const int own = group_of_[f];
    double best = kBetter * fitter_.max_depth(groups_[own].surface, f);
    if (best < tolerance_.eps) return -1;
    const Facet& facet = graph_.facets[f];
    int found = -1;
    for (const FacetNeighbor& n : graph_.neighbors(f)) {
      const int g = group_of_[n.facet];
      if (g < 0 || g == own || g == found) continue;
      const Surface& s = groups_[g].surface;
      const double d = fitter_.max_depth(s, f);
      if (d >= best) continue;
      const bool agrees =
          fitter_.is_tiny(f) || unsigned_angle(s.gradient(facet.centroid), facet.normal) < kMaxTurn;
      if (!agrees) continue;
      best = d;
      found = g;
    }
    return found;
  }

  const FacetGraph& graph_;
  SurfaceTolerance tolerance_;
  FacetFitter fitter_;
  std::vector<GrownGroup>& groups_;
  std::vector<int>& group_of_;
};

}  // namespace

void relax_borders(const Mesh& mesh, const FacetGraph& graph, const SurfaceTolerance& tolerance,
                   FacetGroups& found, const RunContext& run) {
  BorderRelaxer(mesh, graph, tolerance, found).run(run);
}

}  // namespace hewn
