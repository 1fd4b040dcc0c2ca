#pragma once
/// Vectors for kernels. Only operations that round alike everywhere (+ - * / and square roots), so
/// that every device gives the same bits.
#include <cmath>

#include "core/compute/host_device.h"

namespace hewn {

struct PlainVec {
  double x = 0, y = 0, z = 0;
};

HEWN_HD PlainVec operator+(const PlainVec& a, const PlainVec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HEWN_HD PlainVec operator-(const PlainVec& a, const PlainVec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HEWN_HD PlainVec operator*(const PlainVec& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
HEWN_HD double dot(const PlainVec& a, const PlainVec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
HEWN_HD PlainVec cross(const PlainVec& a, const PlainVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HEWN_HD double length(const PlainVec& a) { return sqrt(dot(a, a)); }

/// Two unit vectors that complete a unit vector to a right-handed frame, as `tangents` of
/// core/base/math.h does.
struct PlainFrame {
  PlainVec u, w;
};
HEWN_HD PlainFrame frame_of(const PlainVec& axis) {
  const PlainVec helper = fabs(axis.x) < 0.6 ? PlainVec{1, 0, 0} : PlainVec{0, 1, 0};
  const PlainVec across = cross(helper, axis);
  const PlainVec u = across * (1 / length(across));
  return {u, cross(axis, u)};
}

/// The angle of the vector (x, y) to the x axis, in [0, pi], to 4e-16. Requires: y >= 0.
///
/// Libraries' arc tangents differ in their last bits. Here the angle is halved twice, which leaves
/// at most pi / 16 for a series of eleven terms.
HEWN_HD double angle_of(double x, double y) {
  const double low = fmin(fabs(x), y);
  const double high = fmax(fabs(x), y);
  if (!(high > 0)) return 0;
  double t = low / high;
  for (int halving = 0; halving < 2; ++halving) t = t / (1 + sqrt(1 + t * t));
  const double square = t * t;
  double series = 0;
  for (int k = 11; k >= 0; --k) series = 1.0 / (2 * k + 1) - square * series;
  double angle = 4 * t * series;
  constexpr double kHalfTurn = 3.141592653589793238;
  if (y > fabs(x)) angle = kHalfTurn / 2 - angle;
  return x < 0 ? kHalfTurn - angle : angle;
}
HEWN_HD double angle_between(const PlainVec& a, const PlainVec& b) {
  return angle_of(dot(a, b), length(cross(a, b)));
}

}  // namespace hewn
