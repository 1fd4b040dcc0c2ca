#pragma once
/// What Gauss-Newton needs of each kind of surface: its parameters, the derivatives of distances
/// and normals by them, and the surface after a step.
#include "core/compute/kernels/plain_vec.h"
#include "core/compute/kernels/surface_form.h"

namespace hewn {

// Parameters of each kind, in this order; the axis tilts within its tangent plane (u, w):
//   plane    tilt u, tilt w, offset
//   sphere   centre xyz, radius
//   cylinder axis point u, axis point w, tilt u, tilt w, radius
//   cone     apex xyz, tilt u, tilt w, half angle
//   torus    centre xyz, tilt u, tilt w, tube radius, major radius
inline constexpr int kMostParameters = 7;

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

/// The same as constants, which nvcc takes in kernels, unlike calls.
template <SurfaceKind K>
inline constexpr int kParameters = parameters(K);
template <SurfaceKind K>
inline constexpr int kFirstTilt = first_tilt(K);

/// A surface with what all its rows share.
struct RowFrame {
  PlainVec point, axis;
  PlainFrame tilt;
  double first, second;  ///< as in `SurfaceForm`
};

HEWN_HD RowFrame row_frame(const SurfaceForm& s) {
  const PlainVec axis{s.axis[0], s.axis[1], s.axis[2]};
  return {{s.point[0], s.point[1], s.point[2]}, axis, frame_of(axis), s.first, s.second};
}

/// Lengths below this have no direction; the data are of size one.
inline constexpr double kNoLength = 1e-14;

/// A comparison rather than `fmax`, which is a call that keeps a loop from vector instructions.
HEWN_HD double larger_of(double a, double b) { return a > b ? a : b; }

/// A point in the surface's own frame.
struct LocalPoint {
  PlainVec d;        ///< from the surface's point
  double height;     ///< along the axis
  double radial;     ///< from the axis
  PlainVec outward;  ///< unit, from the axis; of no length on it
};

HEWN_HD LocalPoint localise(const RowFrame& s, const PlainVec& x) {
  LocalPoint p;
  p.d = x - s.point;
  p.height = dot(s.axis, p.d);
  const PlainVec across = p.d - s.axis * p.height;
  p.radial = length(across);
  p.outward = across * (1 / larger_of(p.radial, kNoLength));
  return p;
}

HEWN_HD void set_first_three(double* row, const PlainVec& v) {
  row[0] = v.x;
  row[1] = v.y;
  row[2] = v.z;
}

/// The distance and its derivatives by the parameters.
template <SurfaceKind K>
HEWN_HD double distance_row(const RowFrame& s, const PlainVec& x, double* row) {
  if constexpr (K == SurfaceKind::Plane) {
    row[0] = dot(s.tilt.u, x);
    row[1] = dot(s.tilt.w, x);
    row[2] = -1;
    return dot(s.axis, x) - s.first;
  } else if constexpr (K == SurfaceKind::Sphere) {
    const PlainVec d = x - s.point;
    const double l = length(d);
    set_first_three(row, d * (-1 / larger_of(l, kNoLength)));
    row[3] = -1;
    return l - s.first;
  } else {
    const LocalPoint p = localise(s, x);
    const double eu = dot(p.outward, s.tilt.u);
    const double ew = dot(p.outward, s.tilt.w);
    if constexpr (K == SurfaceKind::Cylinder) {
      row[0] = -eu;
      row[1] = -ew;
      row[2] = -p.height * eu;
      row[3] = -p.height * ew;
      row[4] = -1;
      return p.radial - s.first;
    } else if constexpr (K == SurfaceKind::Cone) {
      const double along = p.height * s.first + p.radial * s.second;
      set_first_three(row, s.axis * s.second - p.outward * s.first);
      row[3] = -eu * along;
      row[4] = -ew * along;
      row[5] = -along;
      return p.radial * s.first - p.height * s.second;
    } else {
      const double dr = p.radial - s.second;
      const double tube = sqrt(dr * dr + p.height * p.height);
      const double inverse = 1 / larger_of(tube, kNoLength);
      const double tilt = p.height * s.second * inverse;
      set_first_three(row, (p.outward * dr + s.axis * p.height) * -inverse);
      row[3] = tilt * eu;
      row[4] = tilt * ew;
      row[5] = -1;
      row[6] = -dr * inverse;
      return tube - s.first;
    }
  }
}

/// The outward normal at a point.
template <SurfaceKind K>
HEWN_HD PlainVec normal_at(const RowFrame& s, const LocalPoint& p) {
  if constexpr (K == SurfaceKind::Plane) {
    return s.axis;
  } else if constexpr (K == SurfaceKind::Sphere) {
    return p.d * (1 / larger_of(length(p.d), kNoLength));
  } else if constexpr (K == SurfaceKind::Cylinder) {
    return p.outward;
  } else if constexpr (K == SurfaceKind::Cone) {
    return p.outward * s.first - s.axis * s.second;
  } else {
    const PlainVec from_tube = p.outward * (p.radial - s.second) + s.axis * p.height;
    return from_tube * (1 / larger_of(length(from_tube), kNoLength));
  }
}

/// What parameter `j` moves, as changes of the surface's own values.
struct Variation {
  PlainVec point, axis;
  double angle = 0, major = 0;
};

HEWN_HD PlainVec unit_vector(int k) {
  return {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
}

template <SurfaceKind K>
HEWN_HD Variation variation(const RowFrame& s, int j) {
  Variation v;
  if constexpr (K == SurfaceKind::Plane) {
    if (j < 2) v.axis = j == 0 ? s.tilt.u : s.tilt.w;
  } else if constexpr (K == SurfaceKind::Sphere) {
    if (j < 3) v.point = unit_vector(j);
  } else if constexpr (K == SurfaceKind::Cylinder) {
    if (j < 2) v.point = j == 0 ? s.tilt.u : s.tilt.w;
    if (j == 2 || j == 3) v.axis = j == 2 ? s.tilt.u : s.tilt.w;
  } else {
    if (j < 3) v.point = unit_vector(j);
    if (j == 3 || j == 4) v.axis = j == 3 ? s.tilt.u : s.tilt.w;
    if (j == 5 && K == SurfaceKind::Cone) v.angle = 1;
    if (j == 6) v.major = 1;
  }
  return v;
}

/// The change of the `normal` at a point with a variation.
template <SurfaceKind K>
HEWN_HD PlainVec normal_change(const RowFrame& s, const LocalPoint& p, const PlainVec& normal,
                               const Variation& v) {
  if constexpr (K == SurfaceKind::Plane) {
    return v.axis;
  } else if constexpr (K == SurfaceKind::Sphere) {
    return (v.point - normal * dot(normal, v.point)) * (-1 / larger_of(length(p.d), kNoLength));
  } else {
    const PlainVec t = cross(s.axis, p.outward);
    const double turn_out =
        (dot(t, v.point) + p.height * dot(t, v.axis)) / larger_of(p.radial, kNoLength);
    const PlainVec change = t * -turn_out - s.axis * dot(p.outward, v.axis);
    if constexpr (K == SurfaceKind::Cylinder) {
      return change;
    } else if constexpr (K == SurfaceKind::Cone) {
      return change * s.first - v.axis * s.second -
             (p.outward * s.second + s.axis * s.first) * v.angle;
    } else {
      const double height_change = dot(v.axis, p.d) - dot(s.axis, v.point);
      const double radial_change = -dot(p.outward, v.point) - p.height * dot(p.outward, v.axis);
      const double dr = p.radial - s.second;
      const double tube2 = larger_of(dr * dr + p.height * p.height, kNoLength * kNoLength);
      const double tube = sqrt(tube2);
      const double turn = (height_change * dr - p.height * (radial_change - v.major)) / tube2;
      return change * (dr / tube) + v.axis * (p.height / tube) +
             (s.axis * dr - p.outward * p.height) * (turn / tube);
    }
  }
}

/// The axis after a tilt; unchanged to the bit by no tilt.
HEWN_HD PlainVec tilted(const RowFrame& s, double u, double w) {
  if (u == 0 && w == 0) return s.axis;
  const PlainVec sum = s.axis + s.tilt.u * u + s.tilt.w * w;
  return sum * (1 / length(sum));
}

/// The surface after the step `x`. Requires, for a cylinder: data around the origin, the place that
/// its point stays next to.
template <SurfaceKind K>
HEWN_HD SurfaceForm stepped(const SurfaceForm& surface, const double* x) {
  const RowFrame s = row_frame(surface);
  SurfaceForm r = surface;
  PlainVec point = s.point;
  PlainVec axis = s.axis;
  if constexpr (K == SurfaceKind::Plane) {
    axis = tilted(s, x[0], x[1]);
    r.first += x[2];
  } else if constexpr (K == SurfaceKind::Sphere) {
    point = point + PlainVec{x[0], x[1], x[2]};
    r.first += x[3];
  } else if constexpr (K == SurfaceKind::Cylinder) {
    point = point + s.tilt.u * x[0] + s.tilt.w * x[1];
    axis = tilted(s, x[2], x[3]);
    point = point - axis * dot(axis, point);
    r.first += x[4];
  } else {
    point = point + PlainVec{x[0], x[1], x[2]};
    axis = tilted(s, x[3], x[4]);
    if constexpr (K == SurfaceKind::Cone) {
      // Turns the flank without a sine, which libraries round differently.
      const double cosine = s.first - s.second * x[5];
      const double sine = s.second + s.first * x[5];
      const double inverse = 1 / sqrt(cosine * cosine + sine * sine);
      r.first = cosine * inverse;
      r.second = sine * inverse;
    } else {
      r.first += x[5];
      r.second += x[6];
    }
  }
  set_first_three(r.point, point);
  set_first_three(r.axis, axis);
  return r;
}

}  // namespace hewn
