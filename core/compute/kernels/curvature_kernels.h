#pragma once
/// Principal curvatures of triangles (Rusinkiewicz 2004), in three passes, and what they suggest.
#include "core/compute/kernels/mesh_form.h"

namespace hewn {

/// A symmetric tensor [a b; b c] in the tangent frame of some normal.
struct CurvatureTensor {
  double a = 0, b = 0, c = 0;
};

HEWN_HD CurvatureTensor operator+(const CurvatureTensor& s, const CurvatureTensor& t) {
  return {s.a + t.a, s.b + t.b, s.c + t.c};
}
HEWN_HD CurvatureTensor operator*(const CurvatureTensor& t, double s) {
  return {t.a * s, t.b * s, t.c * s};
}

/// Turns `v` as the shortest turn does that takes the unit vector `from` to `to`.
HEWN_HD PlainVec turned(const PlainVec& v, const PlainVec& from, const PlainVec& to) {
  const double cosine = dot(from, to);
  if (cosine < -1 + 1e-12) {  // half a turn, about any tangent
    const PlainVec axis = frame_of(from).u;
    return axis * (2 * dot(axis, v)) - v;
  }
  const PlainVec axis = cross(from, to);
  const PlainVec first = cross(axis, v);
  return v + first + cross(axis, first) * (1 / (1 + cosine));
}

/// The same tensor seen in the frame of another plane: the plane is turned about the line in which
/// both meet, so that nothing is lost by foreshortening.
HEWN_HD CurvatureTensor turned(const CurvatureTensor& t, const PlainVec& from_normal,
                               const PlainVec& to_normal) {
  const PlainFrame from = frame_of(from_normal);
  const PlainFrame to = frame_of(to_normal);
  const PlainVec u = turned(to.u, to_normal, from_normal);
  const PlainVec w = turned(to.w, to_normal, from_normal);
  const double uu = dot(u, from.u), uw = dot(u, from.w);
  const double wu = dot(w, from.u), ww = dot(w, from.w);
  return {uu * (t.a * uu + t.b * uw) + uw * (t.b * uu + t.c * uw),
          uu * (t.a * wu + t.b * ww) + uw * (t.b * wu + t.c * ww),
          wu * (t.a * wu + t.b * ww) + ww * (t.b * wu + t.c * ww)};
}

/// First pass: the tensor of a triangle maps each side to the change of normals along it, by least
/// squares. One item is one triangle.
struct TriangleTensorKernel : MeshKernel {
  const PlainVec* normals = nullptr;   ///< by corner number
  CurvatureTensor* tensors = nullptr;  ///< out, by triangle

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const int t = number_of(item);
    tensors[t] = mesh.areas[t] > 0 ? tensor_of(t) : CurvatureTensor{};
  }

 private:
  HEWN_HD CurvatureTensor tensor_of(int t) const {
    const PlainFrame frame = frame_of(mesh.normals[t]);
    // Two rows for each side (x, y) with the change (f, g): (x, y, 0) -> f and (0, x, y) -> g.
    double xx = 0, xy = 0, yy = 0, fx = 0, fy_gx = 0, gy = 0;
    for (int k = 0; k < 3; ++k) {
      const int here = 3 * t + k;
      const int there = 3 * t + (k + 1) % 3;
      const PlainVec side = mesh.position(there) - mesh.position(here);
      const PlainVec change = normals[there] - normals[here];
      const double x = dot(side, frame.u), y = dot(side, frame.w);
      const double f = dot(change, frame.u), g = dot(change, frame.w);
      xx += x * x;
      xy += x * y;
      yy += y * y;
      fx += x * f;
      fy_gx += y * f + x * g;
      gy += y * g;
    }
    // [xx xy 0; xy xx+yy xy; 0 xy yy] (a b c) = (fx fy_gx gy), by elimination from both ends.
    const double middle = xx + yy - xy * xy / xx - xy * xy / yy;
    const double b = (fy_gx - xy / xx * fx - xy / yy * gy) / middle;
    const CurvatureTensor tensor{(fx - xy * b) / xx, b, (gy - xy * b) / yy};
    // A sliver's tensor may be infinite or undefined; differences of such numbers are undefined.
    const bool is_finite =
        tensor.a - tensor.a == 0 && tensor.b - tensor.b == 0 && tensor.c - tensor.c == 0;
    return is_finite ? tensor : CurvatureTensor{};
  }
};

/// Second pass: the mean of the triangles' tensors around a vertex, weighted by each corner's share
/// of the area, never across a marked side. One item is one vertex. Cost: O(corners).
struct SectorTensorKernel : MeshKernel {
  const PlainVec* normals = nullptr;         ///< by corner number
  const int* sectors = nullptr;              ///< by corner number
  const CurvatureTensor* tensors = nullptr;  ///< by triangle
  CurvatureTensor* sums = nullptr;           ///< out, by sector; 0 at first
  double* weights = nullptr;                 ///< scratch, by sector; 0 at first

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const int vertex = number_of(item);
    const int* const begin = mesh.corners + mesh.first_corner[vertex];
    const int* const end = mesh.corners + mesh.first_corner[vertex + 1];
    for (const int* c = begin; c != end; ++c) {
      const int t = *c / 3;
      if (!(mesh.areas[t] > 0)) continue;
      const int sector = sectors[*c];
      const double weight = corner_area(t, *c % 3);
      sums[sector] = sums[sector] + turned(tensors[t], mesh.normals[t], normals[sector]) * weight;
      weights[sector] += weight;
    }
    for (const int* c = begin; c != end; ++c) {
      if (weights[*c] > 0) sums[*c] = sums[*c] * (1 / weights[*c]);
    }
  }

 private:
  /// The part of the triangle's area that is nearest to its corner (Meyer et al. 2003; an obtuse
  /// triangle's Voronoi regions are cut off at its sides).
  HEWN_HD double corner_area(int t, int corner) const {
    double squared[3];
    for (int k = 0; k < 3; ++k) {
      const PlainVec side = mesh.position(3 * t + (k + 2) % 3) - mesh.position(3 * t + (k + 1) % 3);
      squared[k] = dot(side, side);
    }
    // Barycentric weights of the circumcentre.
    double weight[3];
    const double area = mesh.areas[t];
    for (int k = 0; k < 3; ++k) {
      weight[k] = squared[k] * (squared[(k + 1) % 3] + squared[(k + 2) % 3] - squared[k]);
      if (weight[k] <= 0) return k == corner ? area / 2 : area / 4;
    }
    return area / 2 * (weight[(corner + 1) % 3] + weight[(corner + 2) % 3]) /
           (weight[0] + weight[1] + weight[2]);
  }
};

enum class CurvatureClass : std::uint8_t {
  Planar,
  Spherical,
  SphericalInverted,  ///< hollow: seen from inside the sphere
  Conic,
  ConicInverted,
  Other,  ///< none of the paper's: a torus, a saddle, a transition
  None,   ///< a triangle without area
};

/// The paper's thresholds.
struct CurvatureLimits {
  double planar = 0;  ///< mean curvature, in 1 / model units
  double sphere = 0, cone_low = 0, cone_high = 0;
};

/// Stroeter et al. 2026: planar, spherical, conic, in this order. Compares against |H|: an inverted
/// sphere has negative curvatures. `larger` and `smaller` are by magnitude.
HEWN_HD CurvatureClass class_of(double larger, double smaller, const CurvatureLimits& limits) {
  const double mean = fabs((larger + smaller) / 2);
  const bool is_inverted = larger < 0;
  if (mean < limits.planar) return CurvatureClass::Planar;
  if (fabs(larger) - fabs(smaller) < mean * limits.sphere) {
    return is_inverted ? CurvatureClass::SphericalInverted : CurvatureClass::Spherical;
  }
  if (fabs(larger) > mean * limits.cone_high && fabs(smaller) < mean * limits.cone_low) {
    return is_inverted ? CurvatureClass::ConicInverted : CurvatureClass::Conic;
  }
  return CurvatureClass::Other;
}

/// In 1 / model units, positive where the solid is convex.
struct CurvatureForm {
  double max = 0, min = 0;  ///< of larger and of smaller magnitude
  PlainVec max_direction{1, 0, 0};
};

/// Third pass: a triangle takes the mean of its corners. One item is one triangle.
struct PrincipalKernel : MeshKernel {
  const PlainVec* normals = nullptr;      ///< by corner number
  const int* sectors = nullptr;           ///< by corner number
  const CurvatureTensor* sums = nullptr;  ///< by sector
  CurvatureLimits limits;
  CurvatureForm* curvatures = nullptr;  ///< out
  CurvatureClass* classes = nullptr;    ///< out

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const int t = number_of(item);
    curvatures[t] = CurvatureForm{};
    classes[t] = CurvatureClass::None;
    if (!(mesh.areas[t] > 0)) return;
    CurvatureTensor sum;
    for (int corner = 3 * t; corner < 3 * t + 3; ++corner) {
      sum = sum + turned(sums[sectors[corner]], normals[corner], mesh.normals[t]) * (1.0 / 3);
    }
    curvatures[t] = principal(sum, mesh.normals[t]);
    classes[t] = class_of(curvatures[t].max, curvatures[t].min, limits);
  }

 private:
  static HEWN_HD CurvatureForm principal(const CurvatureTensor& t, const PlainVec& normal) {
    const double mean = (t.a + t.c) / 2;
    const double half = (t.a - t.c) / 2;
    const double spread = sqrt(half * half + t.b * t.b);
    // The direction of mean + spread, from whichever row is longer.
    double x = half >= 0 ? spread + half : t.b;
    double y = half >= 0 ? t.b : spread - half;
    const double norm = sqrt(x * x + y * y);
    x = norm > 0 ? x / norm : 1;
    y = norm > 0 ? y / norm : 0;
    const PlainFrame frame = frame_of(normal);
    if (mean >= 0) return {mean + spread, mean - spread, frame.u * x + frame.w * y};
    return {mean - spread, mean + spread, frame.w * x - frame.u * y};
  }
};

}  // namespace hewn
