#pragma once
/// What Gauss-Newton needs of each kind of surface: its parameters, the distance's derivatives by
/// them, and the surface after a step. Private to this layer.
#include <algorithm>
#include <cmath>

#include "core/csg/surface.h"

namespace hewn {

// Parameters of each kind, in this order; the axis tilts within its tangent plane (u, w):
//   plane    tilt u, tilt w, offset
//   sphere   centre xyz, radius
//   cylinder axis point u, axis point w, tilt u, tilt w, radius
//   cone     apex xyz, tilt u, tilt w, half angle
//   torus    centre xyz, tilt u, tilt w, tube radius, major radius
constexpr int parameters(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::Plane:
      return 3;
    case SurfaceKind::Sphere:
      return 4;
    case SurfaceKind::Cylinder:
      return 5;
    case SurfaceKind::Cone:
      return 6;
    case SurfaceKind::Torus:
      return 7;
  }
  return 0;
}

/// A point in the surface's own frame.
struct LocalPoint {
  Vec3 d;         // from the surface's point
  double height;  // along the axis
  double radial;  // from the axis
  Vec3 outward;   // unit, from the axis
};

inline LocalPoint localise(const Surface& s, const Vec3& x) {
  LocalPoint p;
  p.d = x - s.point;
  p.height = s.axis.dot(p.d);
  const Vec3 q = p.d - s.axis * p.height;
  p.radial = q.norm();
  p.outward = p.radial > 1e-14 ? Vec3(q / p.radial) : tangents(s.axis).u;
  return p;
}

/// A surface with what all its rows share. For as long as the surface lives.
struct RowFrame {
  explicit RowFrame(const Surface& s)
      : surface(s),
        tilt(tangents(s.axis)),
        cosine(s.kind == SurfaceKind::Cone ? std::cos(s.half_angle_rad) : 1),
        sine(s.kind == SurfaceKind::Cone ? std::sin(s.half_angle_rad) : 0) {}

  const Surface& surface;
  Tangents tilt;
  double cosine, sine;  ///< cone only: of the half angle
};

/// Distance and its derivatives by the parameters.
template <SurfaceKind K>
double distance_row(const RowFrame& frame, const Vec3& x,
                    Eigen::Matrix<double, parameters(K), 1>& row) {
  const Surface& s = frame.surface;
  const Tangents& f = frame.tilt;
  if constexpr (K == SurfaceKind::Plane) {
    row << f.u.dot(x), f.w.dot(x), -1;
    return s.axis.dot(x) - s.offset;
  } else if constexpr (K == SurfaceKind::Sphere) {
    const Vec3 d = x - s.point;
    const double length = d.norm();
    row << -d / std::max(length, 1e-14), -1;
    return length - s.radius;
  } else {
    const LocalPoint p = localise(s, x);
    const double eu = p.outward.dot(f.u);
    const double ew = p.outward.dot(f.w);
    if constexpr (K == SurfaceKind::Cylinder) {
      row << -eu, -ew, -p.height * eu, -p.height * ew, -1;
      return p.radial - s.radius;
    } else if constexpr (K == SurfaceKind::Cone) {
      const double c = frame.cosine;
      const double n = frame.sine;
      const double along = p.height * c + p.radial * n;
      row << -(p.outward * c - s.axis * n), -eu * along, -ew * along, -along;
      return p.radial * c - p.height * n;
    } else {
      const double dr = p.radial - s.major_radius;
      const double tube = std::max(std::hypot(dr, p.height), 1e-14);
      const double tilt = p.height * s.major_radius / tube;
      row << -(p.outward * dr + s.axis * p.height) / tube, tilt * eu, tilt * ew, -1, -dr / tube;
      return tube - s.radius;
    }
  }
}

/// A direction in parameter space, as changes of the surface's own values.
struct Variation {
  Vec3 point = Vec3::Zero(), axis = Vec3::Zero();
  double angle = 0, major = 0;
};

template <SurfaceKind K>
Variation variation(const Tangents& f, int j) {
  Variation v;
  if constexpr (K == SurfaceKind::Plane) {
    if (j < 2) v.axis = j == 0 ? f.u : f.w;
  } else if constexpr (K == SurfaceKind::Sphere) {
    if (j < 3) v.point = Vec3::Unit(j);
  } else if constexpr (K == SurfaceKind::Cylinder) {
    if (j < 2) v.point = j == 0 ? f.u : f.w;
    if (j == 2 || j == 3) v.axis = j == 2 ? f.u : f.w;
  } else {
    if (j < 3) v.point = Vec3::Unit(j);
    if (j == 3 || j == 4) v.axis = j == 3 ? f.u : f.w;
    if (j == 5 && K == SurfaceKind::Cone) v.angle = 1;
    if (j == 6) v.major = 1;
  }
  return v;
}

/// Change of the surface's gradient at `x` under a variation.
template <SurfaceKind K>
Vec3 gradient_change(const RowFrame& frame, const LocalPoint& p, const Vec3& gradient,
                     const Variation& v) {
  const Surface& s = frame.surface;
  if constexpr (K == SurfaceKind::Plane) return v.axis;
  if constexpr (K == SurfaceKind::Sphere) {
    return -(v.point - gradient * gradient.dot(v.point)) / std::max(p.d.norm(), 1e-14);
  }
  const Vec3 t = s.axis.cross(p.outward);
  const double radial = std::max(p.radial, 1e-14);
  const double dh = v.axis.dot(p.d) - s.axis.dot(v.point);
  const double dradial = -p.outward.dot(v.point) - p.height * p.outward.dot(v.axis);
  Vec3 de =
      -t * (t.dot(v.point) + p.height * t.dot(v.axis)) / radial - s.axis * p.outward.dot(v.axis);
  if constexpr (K == SurfaceKind::Cylinder) return de;
  if constexpr (K == SurfaceKind::Cone) {
    const double c = frame.cosine;
    const double n = frame.sine;
    return de * c - v.axis * n - (p.outward * n + s.axis * c) * v.angle;
  }
  const double dr = p.radial - s.major_radius;
  const double tube2 = std::max(dr * dr + p.height * p.height, 1e-28);
  const double tube = std::sqrt(tube2);
  const double c = dr / tube;
  const double n = p.height / tube;
  const double turn = (dh * dr - p.height * (dradial - v.major)) / tube2;
  return de * c + v.axis * n + (s.axis * c - p.outward * n) * turn;
}

/// The axis after a tilt; unchanged to the bit by no tilt.
inline Vec3 tilted(const Vec3& axis, const Tangents& f, double u, double w) {
  return u == 0 && w == 0 ? axis : Vec3((axis + f.u * u + f.w * w).normalized());
}

template <SurfaceKind K>
Surface stepped(const Surface& s, const Tangents& f,
                const Eigen::Matrix<double, parameters(K), 1>& x) {
  Surface r = s;
  if constexpr (K == SurfaceKind::Plane) {
    r.axis = tilted(s.axis, f, x[0], x[1]);
    r.offset += x[2];
  } else if constexpr (K == SurfaceKind::Sphere) {
    r.point += Vec3(x[0], x[1], x[2]);
    r.radius += x[3];
  } else if constexpr (K == SurfaceKind::Cylinder) {
    r.point += f.u * x[0] + f.w * x[1];
    r.axis = tilted(s.axis, f, x[2], x[3]);
    r.point -= r.axis * r.axis.dot(r.point);  // the point nearest to the data's centre
    r.radius += x[4];
  } else {
    r.point += Vec3(x[0], x[1], x[2]);
    r.axis = tilted(s.axis, f, x[3], x[4]);
    if constexpr (K == SurfaceKind::Cone) r.half_angle_rad += x[5];
    if constexpr (K == SurfaceKind::Torus) {
      r.radius += x[5];
      r.major_radius += x[6];
    }
  }
  return r;
}

/// Index of the first tilt parameter; the second follows. -1 for spheres.
constexpr int first_tilt(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::Plane:
      return 0;
    case SurfaceKind::Sphere:
      return -1;
    case SurfaceKind::Cylinder:
      return 2;
    default:
      return 3;
  }
}

}  // namespace hewn
