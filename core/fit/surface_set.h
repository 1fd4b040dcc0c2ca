#pragma once
/// Regularised surfaces: the distinct halfspaces of a part with clean directions and round values.
#include <vector>

#include "core/base/option_table.h"
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/literal.h"
#include "core/csg/surface.h"
#include "core/fit/face_groups.h"

namespace hewn {

/// One halfspace that terms may use.
struct Halfspace {
  Surface surface;
  /// Mesh and surface differ by at most this; a point closer than it has no certain label.
  double tolerance = 0;
  /// Mean signed distance of the mesh's facets from the surface (negative: inscribed facets).
  double mean_offset = 0;
  /// Index into `SurfaceSet::directions` of the axis or normal, which equals it up to sign
  /// exactly; -1 for spheres.
  int direction = -1;
  double area = 0;             ///< of the groups on it; 0 for a separating surface
  bool is_separating = false;  ///< added to tell inside from outside, no group lies on it
  Facets facets;               ///< how the mesh tessellates it
};

/// The halfspaces of a part. Parallel surfaces have bit-identical axes (up to sign), coaxial ones
/// bit-identical axis points, coplanar groups share one halfspace.
struct SurfaceSet {
  std::vector<Vec3> directions;  ///< unit; those along a coordinate axis are exactly unit vectors
  std::vector<Halfspace> halfspaces;
  std::vector<int> halfspace_of_group;  ///< -1: the group is too small or unexplained
  /// Share of the mesh's surface, [0, 1], that no fitted surface explains: triangles on no
  /// halfspace, of free-form patches, or further off than any tessellation.
  double unexplained_area = 0;
};

struct RegulariseOptions {
  /// Largest shift by which directions are made parallel or orthogonal and surfaces are merged, as
  /// a share of the bounding-box diagonal.
  double snap_distance = 1.5e-4;
  /// Largest turn for that, however small the surface.
  double max_turn_deg = 0.57;
  /// Values snap to round ones within this many standard deviations of the fit.
  double round_deviations = 4;
  bool round_values = true;
  /// Whether the planes of free-form patches (groups that are not fitted) become halfspaces, too.
  bool keep_free_form = true;
};

template <>
std::span<const OptionField<RegulariseOptions>> option_table<RegulariseOptions>();

/// Makes surfaces parallel, orthogonal, coaxial, coplanar and equal, and snaps values to round
/// ones, each only within the fits' own tolerance.
Result<SurfaceSet> regularise(const Mesh& mesh, const Segmentation& segmentation,
                              const RegulariseOptions& options, const RunContext& run);

}  // namespace hewn
