#pragma once
/// Segmentation of a mesh into face groups, two methods behind one interface.
#include "core/base/option_table.h"
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fit/face_groups.h"
#include "core/mesh/mesh.h"
#include "core/segment/curvature/curvature_options.h"

namespace hewn {

enum class SegmentMethod : int { Facets, Curvature };

struct SegmentOptions {
  int method = static_cast<int>(SegmentMethod::Facets);
  // Each method adds its own tunables below, with one line in the option table.

  // Facets. Lengths are shares of the mesh's bounding-box diagonal.
  double noise = 0;                 ///< of the vertices, standard deviation; 0: estimate it
  double plane_tolerance = 1.5e-5;  ///< vertices of a flat facet off its plane (noise may widen it)
  double vertex_tolerance = 1e-5;   ///< what exact vertices stray (noise may widen it)
  double max_deviation = 1e-3;      ///< of a surface that is not exact
  double smooth_angle_deg = 25;     ///< rims that turn by less join facets of one surface
  double max_looseness = 3;         ///< deviation against a tenth of the facets' depth
  double loose_factor = 5;          ///< second try of inexact designs: times vertex_tolerance
  int seeds = 8;                    ///< tried for each group
  int max_failures = 12;            ///< rounds of seeds in vain before a component is given up

  /// Of the other method; its fields have an option table of their own.
  CurvatureOptions curvature;
};

template <>
std::span<const OptionField<SegmentOptions>> option_table<SegmentOptions>();

/// Partitions the mesh's triangles into face groups.
/// Fails with: BadMesh (nothing to segment), Cancelled.
Result<Segmentation> segment(const Mesh& mesh, const SegmentOptions& options,
                             const RunContext& run);

}  // namespace hewn
