#pragma once
/// The eighths of a box. Internal to core/sample.
#include "core/base/math.h"

namespace hewn {

/// Bit k of `octant`: the upper half along axis k.
inline Box3 octant_of(const Box3& box, int octant) {
  const Vec3 middle = box.center();
  Box3 part;
  for (int k = 0; k < 3; ++k) {
    const bool is_upper = ((octant >> k) & 1) != 0;
    part.lo[k] = is_upper ? middle[k] : box.lo[k];
    part.hi[k] = is_upper ? box.hi[k] : middle[k];
  }
  return part;
}

}  // namespace hewn
