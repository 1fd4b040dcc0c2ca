#pragma once
/// Segmentation into face groups by curvature (Stroeter et al. 2026, section "Segmentation into
/// Face Groups"). In this order: stages (on the device that suits), fit_regions, resolve_regions.
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fit/face_groups.h"
#include "core/mesh/mesh.h"
#include "core/segment/curvature/curvature_options.h"

namespace hewn {

struct SegmentOptions;

/// Groups with fitted surfaces, ordered by their lowest triangle; noise and facets as for the other
/// method, so that every later stage can work with the result.
/// Fails with: BadMesh (no triangle with an area), Cancelled.
/// Cost: O(n log n) where primitives fit. Same result for any thread count.
Result<Segmentation> segment_by_curvature(const Mesh& mesh, const SegmentOptions& options,
                                          const RunContext& run);

/// The same without noise and facets.
Result<Segmentation> segment_by_curvature(const Mesh& mesh, const CurvatureOptions& options,
                                          const RunContext& run);

}  // namespace hewn
