#pragma once
/// The primitive that a set of triangles lies on (Stroeter et al. 2026, section "Primitive
/// Fitting").
#include <optional>
#include <span>
#include <vector>

#include "core/csg/surface.h"
#include "core/segment/curvature/stages.h"

namespace hewn {

/// What a fit must keep to, from the options and the mesh's size.
struct FitLimits {
  double diagonal = 0;
  double distance = 0;   ///< eps^d in model units
  double angle_rad = 0;  ///< eps^n
};

FitLimits fit_limits(const Mesh& mesh, const CurvatureOptions& options);

/// Fits the primitive that the class suggests: a plane, a sphere, or for conic triangles a cylinder
/// when all normals are perpendicular to the region's axis, else a cone. Beyond the paper: flat
/// triangles give a plane whatever their class, because beside a fillet the estimate is off; and
/// when the primitive is inexact, as on a fillet around a rim, a torus is tried too.
///
/// Empty when no primitive keeps to the limits: the largest distance of a vertex, and the area
/// weighted mean angle between the triangles' normals and the surface.
/// Cost: O(triangles log triangles); at most some hundred triangles take part in the fit itself.
std::optional<Surface> fit_primitive(const Mesh& mesh, std::span<const int> triangles,
                                     CurvatureClass curvature, const FitLimits& limits);

/// What one fit is for.
struct FitRegion {
  std::span<const int> triangles;
  CurvatureClass curvature = CurvatureClass::Other;
};

/// The same, to the bit, for many regions, whose fits run side by side. One outcome for each.
/// Fails with: Cancelled.
Result<std::vector<std::optional<Surface>>> fit_primitives(const Mesh& mesh,
                                                           std::span<const FitRegion> regions,
                                                           const FitLimits& limits,
                                                           const RunContext& run);

/// Whether the triangles lie in one plane within what rounding explains.
bool is_flat(const Mesh& mesh, std::span<const int> triangles, const FitLimits& limits);

/// The plane through the mean of the vertices along the area-weighted sum of the normals.
Surface mean_plane(const Mesh& mesh, std::span<const int> triangles);

/// How badly a triangle fits a surface: the largest distance of its corners over `distance` plus
/// the angle of its normal over `angle_rad`; normals may point either way.
double misfit(const Mesh& mesh, int triangle, const Surface& surface, const FitLimits& limits);

/// Root mean square distance of the triangles' vertices.
double rms_of(const Mesh& mesh, std::span<const int> triangles, const Surface& surface);

/// Whether the vertices lie on the surface within what rounding explains.
bool is_exact(double rms, const FitLimits& limits);

/// The limits for triangles that may join an exact surface. Where other faces trim a curved face,
/// their rims run along its chords: such vertices lie inside by up to the facets' depth, which is
/// taken from `triangles`.
FitLimits trimmed_limits(const Mesh& mesh, std::span<const int> triangles, const Surface& surface,
                         const FitLimits& limits);

/// Refits the surface to the triangles' vertices, to those that lie on it exactly where there are
/// enough; leaves it when that fails or worsens it.
void refit(const Mesh& mesh, std::span<const int> triangles, Surface& surface);

}  // namespace hewn
