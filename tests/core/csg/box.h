#pragma once
/// Boxes by their corners.
#include "core/csg/literal.h"

namespace hewn::testing {

/// From `lo` to `hi` in coordinates turned by `rotation`.
inline Literal box(const Vec3& lo, const Vec3& hi, const Mat3& rotation = Mat3::Identity()) {
  Literal s;
  s.rotation = rotation;
  s.origin = lo;
  s.size = hi - lo;
  return s;
}

}  // namespace hewn::testing
