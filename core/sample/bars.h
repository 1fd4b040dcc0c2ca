#pragma once
/// Bars: rectangular ones, rods and drilled holes, as far as their sides can be seen. Internal to
/// core/sample.
#include <vector>

#include "core/sample/sample_table.h"

namespace hewn {

/// Directions that differ by less are the same, radians.
inline constexpr double kSameBarDirection = 1e-4;

/// A part of the solid, or of a hole, between sides along one direction.
struct Bar {
  Vec3 along = Vec3::UnitZ();
  double lo = 0, hi = 0;  ///< of its sides, as far as they can be seen
  double thickness = 0;
  Label label = Label::Inside;  ///< between its sides
  /// Points between the sides, close to them, at each end.
  std::vector<Vec3> low_rim, high_rim;
};

/// Four sides around, with outer edges between them, or a cylinder or cone that goes all the way
/// round. Cost: O(n log n) for n triangles.
std::vector<Bar> find_bars(const SampleSpace& space, const SurfaceSet& surfaces);

}  // namespace hewn
