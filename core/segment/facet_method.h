#pragma once
/// Segmentation by facet merging and growth with incremental fits: the default method.
#include "core/segment/segment.h"

namespace hewn {

/// Partitions the triangles of a CAD tessellation. Background: docs/architecture.md
/// Fails with: BadMesh, Cancelled. Cost: near-linear; about 0.1 s for 10,000 triangles.
Result<Segmentation> segment_by_facets(const Mesh& mesh, const SegmentOptions& options,
                                       const RunContext& run);

}  // namespace hewn
