#pragma once
/// Segmentation of a mesh into face groups, two methods behind one interface.
#include "core/base/option_table.h"
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fit/face_groups.h"
#include "core/mesh/mesh.h"

namespace hewn {

enum class SegmentMethod : int { Facets, Curvature };

struct SegmentOptions {
  int method = static_cast<int>(SegmentMethod::Facets);
  // Each method adds its own tunables below, with one line in the option table.
};

template <>
std::span<const OptionField<SegmentOptions>> option_table<SegmentOptions>();

/// Partitions the mesh's triangles into face groups.
/// Fails with: BadMesh (nothing to segment), Cancelled.
Result<Segmentation> segment(const Mesh& mesh, const SegmentOptions& options,
                             const RunContext& run);

}  // namespace hewn
