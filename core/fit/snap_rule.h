#pragma once
/// How far regularisation may move a fitted value.
#include <algorithm>

#include "core/fit/surface_set.h"

namespace hewn {

/// As far as the fit leaves it open and the mesh's noise blurs it, and never beyond the reach.
struct SnapRule {
  double deviations = 0;  ///< standard deviations that count as open
  double noise = 0;       ///< of the mesh, model units
  double reach = 0;       ///< model units

  SnapRule(const RegulariseOptions& options, double diagonal, double mesh_noise)
      : deviations(options.round_deviations),
        noise(mesh_noise),
        reach(options.snap_distance * diagonal) {}

  /// `deviation`: one standard deviation of the value.
  double tolerance(double deviation) const {
    return std::min(deviations * deviation + noise, reach);
  }
};

}  // namespace hewn
