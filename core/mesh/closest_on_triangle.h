#pragma once
/// The point of a triangle nearest to another point, in double precision.
#include <algorithm>

#include "core/base/math.h"

namespace hewn {

/// Ericson, Real-Time Collision Detection (2005), section 5.1.5. Copes with zero-area triangles.
inline Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto on_edge = [](const Vec3& from, const Vec3& step, double numerator) {
    const double length2 = step.squaredNorm();
    if (!(length2 > 0)) return from;
    return Vec3(from + step * std::clamp(numerator / length2, 0.0, 1.0));
  };
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return on_edge(a, ab, d1);
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return on_edge(a, ac, d2);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const Vec3 bc = c - b;
    return on_edge(b, bc, bc.dot(bp));
  }
  const double sum = va + vb + vc;
  return a + ab * (vb / sum) + ac * (vc / sum);
}

}  // namespace hewn
