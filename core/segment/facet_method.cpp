#include "core/segment/facet_method.h"

#include <algorithm>

#include "core/compute/parallel.h"
#include "core/fit/gauss_newton.h"
#include "core/segment/coaxial.h"
#include "core/segment/curved_growth.h"
#include "core/segment/developable.h"
#include "core/segment/facet_noise.h"
#include "core/segment/leftovers.h"
#include "core/segment/plane_rings.h"
#include "core/segment/polish.h"
#include "core/segment/relax_borders.h"
#include "core/segment/scattered.h"

namespace hewn {
namespace {

constexpr double kResampledShare = 0.15;  // of the vertices, inside flat facets
constexpr int kManyPieces = 4;
constexpr double kWorthwhile = 0.93;  // of the groups
constexpr double kRounded = 1.5e-6;   // share of the diagonal: rounding stays below

SurfaceTolerance surface_tolerance(const Mesh& mesh, double noise, const SegmentOptions& options) {
  const double diagonal = mesh.diagonal();
  // Twice the noise: corners are compared with up to twice eps, that is four standard deviations.
  return {diagonal, noise, std::max(options.vertex_tolerance * diagonal, 2 * noise)};
}

/// One run at one exactness.
struct Attempt {
  FacetGraph graph;
  FacetGroups found;
  SurfaceTolerance tolerance;
  bool is_free_form = false;  ///< at least one smooth component
};

/// A curved group with its corners.
struct CurvedGroup {
  GrownGroup* group;
  std::vector<Vec3> corners;
};

std::vector<CurvedGroup> curved_groups(const Mesh& mesh, Attempt& a) {
  FacetFitter fitter(mesh, a.graph, a.tolerance);
  std::vector<CurvedGroup> curved;
  for (GrownGroup& group : a.found.groups) {
    if (group.surface.kind == SurfaceKind::Plane) continue;
    curved.push_back({&group, {}});
    for (const int v : fitter.corner_indices(group.facets)) {
      curved.back().corners.push_back(mesh.vertices[v]);
    }
  }
  return curved;
}

/// Planes along the coordinate axes hide the rounding of a file's digits, curved surfaces show it:
/// the median deviation of the groups whose corners agree almost exactly. 0 when cancelled.
double noise_on_curves(std::span<const CurvedGroup> curved, double limit, const RunContext& run) {
  std::vector<FitTask> tasks;
  for (const CurvedGroup& c : curved) {
    tasks.push_back({c.group->surface, {.points = c.corners}});
    tasks.back().settings.min_decrease = 1e-9;
  }
  if (!refine_surfaces(tasks, run)) return 0;
  std::vector<double> deviations;
  for (const FitTask& task : tasks) {
    const double rms = task.is_fitted ? rms_distance(task.surface, task.data.points) : kInfinity;
    if (rms < limit) deviations.push_back(rms);
  }
  if (deviations.empty()) return 0;
  const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  return *middle;
}

FaceGroup measured_group(const Mesh& mesh, const FacetGraph& graph, const GrownGroup& grown,
                         FacetFitter& fitter) {
  FaceGroup group;
  group.surface = grown.surface;
  double agreement = 0;
  for (const int f : grown.facets) {
    const Facet& facet = graph.facets[f];
    group.triangles.insert(group.triangles.end(), facet.triangles.begin(), facet.triangles.end());
    group.area += facet.area;
    agreement += facet.area * grown.surface.gradient(facet.centroid).dot(facet.normal);
    for (const int v : graph.vertices(f)) {
      group.max_deviation =
          std::max(group.max_deviation, std::abs(grown.surface.signed_distance(mesh.vertices[v])));
    }
  }
  std::sort(group.triangles.begin(), group.triangles.end());
  group.side = agreement < 0 ? -1 : 1;
  const FitQuality quality = fitter.evaluate(grown.surface, grown.facets);
  group.max_deviation = std::max(group.max_deviation, quality.sagitta);
  group.rms_deviation = quality.rms_distance;
  return group;
}

Segmentation assemble(const Mesh& mesh, const FacetGraph& graph,
                      const std::vector<GrownGroup>& groups, const SurfaceTolerance& tolerance) {
  Segmentation result;
  result.noise = tolerance.noise;
  result.group_of_triangle.assign(mesh.triangles.size(), -1);
  FacetFitter fitter(mesh, graph, tolerance);
  for (const GrownGroup& grown : groups) {
    for (const int f : grown.facets) {
      for (const int t : graph.facets[f].triangles) {
        result.group_of_triangle[t] = static_cast<int>(result.groups.size());
      }
    }
    result.groups.push_back(measured_group(mesh, graph, grown, fitter));
  }
  result.facets = graph.facets;
  result.facet_of_triangle = graph.facet_of_triangle;
  return result;
}

void polish_groups(const Mesh& mesh, Attempt& a, const RunContext& run) {
  const std::vector<CurvedGroup> curved = curved_groups(mesh, a);
  a.tolerance.noise =
      std::max(a.tolerance.noise, noise_on_curves(curved, kRounded * mesh.diagonal(), run));
  for_each_index(run.threads, curved.size(), [&](std::size_t i) {
    if (curved[i].group->is_settled || run.is_cancelled()) return;
    polish_on_envelope(curved[i].group->surface, curved[i].corners, a.tolerance);
  });
}

/// Segments with tolerances `looseness` times the exact ones.
Result<Attempt> attempt(const FacetMerger& merger, double noise, double looseness,
                        const SegmentOptions& options, const RunContext& run) {
  const Mesh& mesh = merger.mesh();
  Attempt a;
  a.tolerance = surface_tolerance(mesh, noise, options);
  a.tolerance.eps =
      std::max(a.tolerance.eps, looseness * options.vertex_tolerance * mesh.diagonal());
  const double plane =
      std::max(std::min(2.0, looseness) * options.plane_tolerance * mesh.diagonal(), 4.5 * noise);
  a.graph = build_facets(merger, {plane, noise}, run);
  a.tolerance.is_resampled = a.graph.interior_share > kResampledShare;
  if (run.is_cancelled()) return RunContext::cancelled();
  a.found.group_of.assign(a.graph.facets.size(), -1);
  if (a.tolerance.is_resampled) {
    const Result<void> rings = take_plane_rings(mesh, a.graph, a.tolerance,
                                                options.smooth_angle_deg * kPi / 180, a.found, run);
    if (!rings) return rings.error();
  }
  const Result<int> grown = grow_curved_groups(mesh, a.graph, a.tolerance, options, a.found, run);
  if (!grown) return grown.error();
  a.is_free_form = *grown > 0;
  absorb_slivers(mesh, a.graph, a.tolerance, a.found);
  adopt_facets(mesh, a.graph, a.tolerance, a.found, run);
  const Result<void> planes = plane_leftovers(mesh, a.graph, a.tolerance, a.found, run);
  if (!planes) return planes.error();
  // Later rounds profit from the better fits of the first.
  for (int round = 0; round < 3 && a.tolerance.is_resampled; ++round) {
    if (round == 2) relax_borders(mesh, a.graph, a.tolerance, a.found, run);
    merge_pieces(mesh, a.graph, a.tolerance, a.found, run);
  }
  if (run.is_cancelled()) return RunContext::cancelled();
  dissolve_splinters(mesh, a.graph, a.tolerance, a.found);
  if (run.is_cancelled()) return RunContext::cancelled();
  prefer_developable(mesh, a.graph, a.tolerance, a.found);
  gather_scattered(mesh, a.graph, a.tolerance, a.found);
  adopt_axes(mesh, a.graph, a.tolerance, a.found);
  polish_groups(mesh, a, run);
  if (run.is_cancelled()) return RunContext::cancelled();
  return a;
}

/// Marks small planes that join each other smoothly in numbers as unexplained: a free-form patch.
void mark_free_form(const Attempt& a, double smooth_rad, double total_area, Segmentation& result) {
  constexpr double kFlat = 0.01;
  constexpr double kSmallArea = 2e-3;  // of the mesh's area
  constexpr std::size_t kManyPlanes = 6;
  std::vector<std::vector<int>> joined(a.found.groups.size());
  const auto is_small_plane = [&](int g) {
    return g >= 0 && a.found.groups[g].surface.kind == SurfaceKind::Plane &&
           result.groups[g].area < kSmallArea * total_area;
  };
  for (int f = 0; f < a.graph.size(); ++f) {
    const int g = a.found.group_of[f];
    if (!is_small_plane(g)) continue;
    for (const FacetNeighbor& n : a.graph.neighbors(f)) {
      const int other = a.found.group_of[n.facet];
      if (other == g || !is_small_plane(other)) continue;
      if (n.angle_rad > kFlat && n.angle_rad < smooth_rad) joined[g].push_back(other);
    }
  }
  std::vector<bool> is_seen(a.found.groups.size(), false);
  for (int start = 0; start < static_cast<int>(a.found.groups.size()); ++start) {
    if (is_seen[start] || joined[start].empty()) continue;
    std::vector<int> patch = {start};
    is_seen[start] = true;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const int g : joined[patch[i]]) {
        if (!is_seen[g]) patch.push_back(g);
        is_seen[g] = true;
      }
    }
    if (patch.size() < kManyPlanes) continue;
    for (const int g : patch) result.groups[g].is_fitted = false;
  }
}

/// Facets of planes that join another plane smoothly: pieces of a surface that was not found.
int count_pieces(const Attempt& a, double smooth_rad) {
  constexpr double kFlat = 0.01;
  int pieces = 0;
  const auto is_plane = [&](int f) {
    return a.found.group_of[f] >= 0 &&
           a.found.groups[a.found.group_of[f]].surface.kind == SurfaceKind::Plane;
  };
  for (int f = 0; f < a.graph.size(); ++f) {
    if (!is_plane(f)) continue;
    const auto neighbors = a.graph.neighbors(f);
    pieces += std::any_of(neighbors.begin(), neighbors.end(), [&](const FacetNeighbor& n) {
      return n.angle_rad > kFlat && n.angle_rad < smooth_rad && is_plane(n.facet) &&
             a.found.group_of[n.facet] != a.found.group_of[f];
    });
  }
  return pieces;
}

}  // namespace

Result<Segmentation> segment_by_facets(const Mesh& mesh, const SegmentOptions& options,
                                       const RunContext& run) {
  run.report("segment", 0);
  const auto neighbors = triangle_neighbors(mesh);
  const FacetMerger merger(mesh, neighbors, run);
  const double noise =
      options.noise > 0 ? options.noise * mesh.diagonal() : estimate_noise(merger, run);
  if (run.is_cancelled()) return RunContext::cancelled();
  Result<Attempt> best = attempt(merger, noise, 1, options, run);
  if (!best) return best.error();
  // Some designs are inexact from the start: where surfaces fall to pieces, see whether a looser
  // reading holds them together. It would not do so for a free-form one.
  if (!best->is_free_form &&
      count_pieces(*best, options.smooth_angle_deg * kPi / 180) >= kManyPieces) {
    Result<Attempt> loose = attempt(merger, noise, options.loose_factor, options, run);
    if (!loose) return loose.error();
    const auto worth = static_cast<double>(best->found.groups.size()) * kWorthwhile;
    if (static_cast<double>(loose->found.groups.size()) < worth) best = std::move(loose);
  }
  run.report("segment", 1);
  Segmentation result = assemble(mesh, best->graph, best->found.groups, best->tolerance);
  mark_free_form(*best, options.smooth_angle_deg * kPi / 180, mesh.total_area, result);
  return result;
}

}  // namespace hewn
