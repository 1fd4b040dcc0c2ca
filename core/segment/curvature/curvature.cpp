#include "core/segment/curvature/curvature.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/segment/curvature/resolve_regions.h"
#include "core/segment/facet_noise.h"
#include "core/segment/facets.h"
#include "core/segment/segment.h"

namespace hewn {
namespace {

/// Fits each flooded region as a whole. Where that fails, "we perform the region growing based on
/// primitive fitting within the FG".
Result<std::vector<FittedRegion>> fit_flooded(const CurvatureStages& stages,
                                              const CurvatureOptions& options,
                                              const RunContext& run) {
  std::map<int, std::vector<int>> triangles_of_label;
  for (int t = 0; t < static_cast<int>(stages.labels.size()); ++t) {
    if (stages.labels[t] >= 0) triangles_of_label[stages.labels[t]].push_back(t);
  }
  std::vector<FitRegion> flooded;
  for (const auto& [label, triangles] : triangles_of_label) {
    flooded.push_back({triangles, stages.classes[label]});
  }
  const auto surfaces = fit_primitives(stages.mesh, flooded, fit_limits(stages.mesh, options), run);
  if (!surfaces) return surfaces.error();
  std::vector<FittedRegion> regions;
  std::vector<bool> is_unexplained(stages.labels.size(), false);
  auto surface = surfaces->begin();
  for (auto& [label, triangles] : triangles_of_label) {
    if (surface->has_value()) {
      regions.push_back({**surface, std::move(triangles)});
    } else {
      for (const int t : triangles) is_unexplained[t] = true;
    }
    ++surface;
  }
  auto grown = grow_fitted_regions(stages, is_unexplained, options, run);
  if (!grown) return grown.error();
  for (FittedRegion& region : *grown) regions.push_back(std::move(region));
  return regions;
}

}  // namespace

Result<Segmentation> segment_by_curvature(const Mesh& mesh, const CurvatureOptions& options,
                                          const RunContext& run) {
  if (!(mesh.total_area > 0)) {
    return Error{ErrorCode::BadMesh, "the mesh has no triangle with an area; check its file"};
  }
  run.report("classify curvature", 0);
  const auto stages = compute_stages(mesh, options, run);
  if (!stages) return stages.error();
  run.report("classify curvature", 0.5);
  const bool does_flood = options.growth == static_cast<int>(RegionGrowth::Flood);
  const std::vector<bool> everything(mesh.triangles.size(), true);
  const auto regions = does_flood ? fit_flooded(*stages, options, run)
                                  : grow_fitted_regions(*stages, everything, options, run);
  if (!regions) return regions.error();
  return resolve_regions(*stages, *regions, options, run);
}

Result<Segmentation> segment_by_curvature(const Mesh& mesh, const SegmentOptions& options,
                                          const RunContext& run) {
  Result<Segmentation> result = segment_by_curvature(mesh, options.curvature, run);
  if (!result) return result;
  const auto neighbors = triangle_neighbors(mesh);
  const FacetMerger merger(mesh, neighbors, run);
  const double diagonal = mesh.diagonal();
  result->noise = options.noise > 0 ? options.noise * diagonal : estimate_noise(merger);
  const FacetTolerance tolerance{std::max(options.plane_tolerance * diagonal, 4.5 * result->noise),
                                 result->noise};
  FacetGraph graph = build_facets(merger, tolerance);
  if (run.is_cancelled()) return RunContext::cancelled();
  result->facets = std::move(graph.facets);
  result->facet_of_triangle = std::move(graph.facet_of_triangle);
  return result;
}

}  // namespace hewn
