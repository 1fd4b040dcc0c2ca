#pragma once
/// Gauss-Newton fits of signed distances with analytic Jacobians and Levenberg damping.
#include <span>

#include "core/base/run_context.h"
#include "core/csg/surface.h"

namespace hewn {

/// What a surface is fitted to. Spans must outlive the call.
struct FitData {
  std::span<const Vec3> points;
  /// Unit normals with the places where they were measured; either sign.
  std::span<const Vec3> normals = {};
  std::span<const Vec3> normal_points = {};
};

struct FitSettings {
  int max_iterations = 8;
  /// Weight of a normal's deviation (radians times the extent of the points) against a distance.
  double normal_weight = 0;
  /// > 0: minimise absolute instead of squared distances beyond this distance (IRLS).
  double robust_scale = 0;
  /// Keeps the axis or normal and moves only the other parameters.
  bool keep_axis = false;
  /// Stops when a step lowers the cost by less than this share.
  double min_decrease = 1e-4;
};

/// Improves `surface` (its kind stays) so that the squared distances to the points become minimal.
///
/// Returns false, and leaves `surface` as it was, when the points do not determine the kind, or it
/// degenerates: a radius below zero, a cone of less than 0.02 rad or almost a plane, a torus whose
/// tube covers its axis almost wholly. Coordinates are centred and scaled inside, so far-off parts
/// lose no digits. Cost: O(points x iterations), some 7 ns each.
bool refine_surface(Surface& surface, const FitData& data, const FitSettings& settings = {});

/// One of many fits.
struct FitTask {
  Surface surface;  ///< the guess; later, if `is_fitted`, what it has become
  FitData data;
  FitSettings settings = {};
  bool is_fitted = false;  ///< out
};

/// Does what `refine_surface` does, to the bit, for many surfaces side by side: on the device where
/// it pays, or on all cores. Fails with: Cancelled; then `tasks` are as they were.
Result<void> refine_surfaces(std::span<FitTask> tasks, const RunContext& run);

/// Standard deviations of a fitted surface's values; 0 for values that the kind lacks.
struct FitDeviation {
  double position = 0;  ///< of the point (across the axis for a cylinder)
  double axis_rad = 0;  ///< of the axis or normal; 0 when it is kept
  double offset = 0;    ///< of a plane, at the points' centre
  double radius = 0;
  double major_radius = 0;
  double half_angle_rad = 0;
};

/// How far the values of a fit to `points` may be off when each point strays by `sigma`: the
/// diagonal of the normal equations' inverse. Infinite where the points do not determine a value.
FitDeviation fit_deviation(const Surface& surface, std::span<const Vec3> points, double sigma,
                           bool keep_axis);

/// Root mean square of the points' distances; 0 for no points.
double rms_distance(const Surface& surface, std::span<const Vec3> points);

}  // namespace hewn
