#include "core/segment/facet_method.h"

#include <algorithm>

#include "core/fit/gauss_newton.h"
#include "core/segment/curved_growth.h"
#include "core/segment/leftovers.h"
#include "core/segment/polish.h"

namespace hewn {
namespace {

constexpr double kRounded = 1.5e-6;  // share of the diagonal: rounding stays below

SurfaceTolerance surface_tolerance(const Mesh& mesh, double noise, const SegmentOptions& options) {
  const double diagonal = mesh.diagonal();
  // Twice the noise: corners are compared with up to twice eps, that is four standard deviations.
  return {diagonal, noise, std::max(options.vertex_tolerance * diagonal, 2 * noise)};
}

/// Planes along the coordinate axes hide the rounding of a file's digits, curved surfaces show it:
/// the median deviation of the groups whose corners agree almost exactly.
double noise_on_curves(const Mesh& mesh, const std::vector<GrownGroup>& groups,
                       FacetFitter& fitter, double limit) {
  std::vector<double> deviations;
  for (const GrownGroup& g : groups) {
    if (g.surface.kind == SurfaceKind::Plane) continue;
    std::vector<Vec3> points;
    for (const int v : fitter.corner_indices(g.facets)) points.push_back(mesh.vertices[v]);
    Surface s = g.surface;
    FitSettings settings;
    settings.min_decrease = 1e-9;
    if (!refine_surface(s, {points}, settings)) continue;
    const double rms = rms_distance(s, points);
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

Segmentation assemble(const Mesh& mesh, FacetGraph graph, const std::vector<GrownGroup>& groups,
                      const SurfaceTolerance& tolerance) {
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
  result.facets = std::move(graph.facets);
  result.facet_of_triangle = std::move(graph.facet_of_triangle);
  return result;
}

}  // namespace

Result<Segmentation> segment_by_facets(const Mesh& mesh, const SegmentOptions& options,
                                       const RunContext& run) {
  run.report("segment", 0);
  const auto neighbors = triangle_neighbors(mesh);
  const double noise =
      options.noise > 0 ? options.noise * mesh.diagonal() : estimate_noise(mesh, neighbors);
  if (run.is_cancelled()) return RunContext::cancelled();
  SurfaceTolerance tolerance = surface_tolerance(mesh, noise, options);
  const FacetTolerance facet_tolerance{
      std::max(options.plane_tolerance * mesh.diagonal(), 4.5 * noise), noise};
  FacetGraph graph = build_facets(mesh, neighbors, facet_tolerance);
  if (run.is_cancelled()) return RunContext::cancelled();

  std::vector<int> group_of(graph.facets.size(), -1);
  auto grown = grow_curved_groups(mesh, graph, tolerance, options, group_of, run);
  if (!grown) return grown.error();
  std::vector<GrownGroup>& groups = *grown;
  const std::size_t curved = groups.size();
  absorb_slivers(mesh, graph, tolerance, groups, group_of);
  adopt_facets(mesh, graph, tolerance, groups, group_of);
  const Result<void> planes = plane_leftovers(mesh, graph, tolerance, groups, group_of, run);
  if (!planes) return planes.error();
  FacetFitter fitter(mesh, graph, tolerance);
  tolerance.noise =
      std::max(noise, noise_on_curves(mesh, groups, fitter, kRounded * mesh.diagonal()));
  for (std::size_t g = 0; g < curved; ++g) {
    const std::vector<int> corners = fitter.corner_indices(groups[g].facets);
    std::vector<Vec3> points;
    for (const int v : corners) points.push_back(mesh.vertices[v]);
    polish_on_envelope(groups[g].surface, points, tolerance);
  }
  run.report("segment", 1);
  return assemble(mesh, std::move(graph), groups, tolerance);
}

}  // namespace hewn
