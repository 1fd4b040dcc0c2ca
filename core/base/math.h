#pragma once
/// The small-vector types and helpers that every layer shares.
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Dense>

namespace hewn {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Affine3 = Eigen::Affine3d;

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// An axis-aligned box; empty (lo > hi) until something is added.
struct Box3 {
  Vec3 lo = Vec3::Constant(kInfinity);
  Vec3 hi = Vec3::Constant(-kInfinity);

  void extend(const Vec3& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  bool is_empty() const { return (lo.array() > hi.array()).any(); }
  bool contains(const Vec3& p, double margin = 0) const {
    return (p.array() >= lo.array() - margin).all() && (p.array() <= hi.array() + margin).all();
  }
  Vec3 size() const { return hi - lo; }
  Vec3 center() const { return (lo + hi) / 2; }
  double diagonal() const { return is_empty() ? 0.0 : (hi - lo).norm(); }
};

/// Two unit vectors that complete the unit vector `axis` to a right-handed frame (u, w, axis).
struct Tangents {
  Vec3 u, w;
};
inline Tangents tangents(const Vec3& axis) {
  const Vec3 helper = std::abs(axis.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 u = helper.cross(axis).normalized();
  return {u, axis.cross(u)};
}

/// A right-handed frame whose last column is the unit vector `axis`; that of a coordinate axis
/// consists of coordinate axes.
inline Mat3 frame_about(const Vec3& axis) {
  Mat3 frame;
  for (int c = 0; c < 3; ++c) {
    if (axis[c] > 1 - 1e-12) {
      frame << Vec3::Unit((c + 1) % 3), Vec3::Unit((c + 2) % 3), Vec3::Unit(c);
      return frame;
    }
  }
  const Tangents t = tangents(axis);
  frame << t.u, t.w, axis;
  return frame;
}

/// The angle between two unit vectors, in [0, pi]; accurate for nearly parallel ones too.
inline double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace hewn
