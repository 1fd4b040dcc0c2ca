#include "core/csg/literal.h"

#include <algorithm>
#include <utility>

#include "core/csg/prism.h"
#include "core/mesh/query.h"

namespace hewn {
namespace {

double box_distance(const Vec3& p, const Vec3& size) {
  const Vec3 beyond = (p - size / 2).cwiseAbs() - size / 2;
  return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

/// Distance from `p` to the segment from `a` to `b`.
double segment_distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - ab * t).norm();
}

/// The frustum's profile is a quadrilateral in the half-plane (distance from the axis, height);
/// its side on the axis is no part of the surface.
double frustum_distance(const Literal& s, const Vec3& p) {
  // Squares neither overflow nor vanish at the sizes of parts; `hypot` takes five times as long.
  const Vec2 q(std::sqrt(p.x() * p.x() + p.y() * p.y()), p.z());
  if (s.radius == s.top_radius) {
    const double beyond_flank = q.x() - s.radius;
    const double beyond_end = std::abs(q.y() - s.height / 2) - s.height / 2;
    const Vec2 beyond = Vec2(beyond_flank, beyond_end).cwiseMax(0);
    return beyond.norm() + std::min(std::max(beyond_flank, beyond_end), 0.0);
  }
  const Vec2 bottom(s.radius, 0);
  const Vec2 top(s.top_radius, s.height);
  const double distance =
      std::min({segment_distance(q, Vec2(0, 0), bottom), segment_distance(q, bottom, top),
                segment_distance(q, top, Vec2(0, s.height))});
  const double flank = (q.x() - s.radius) * s.height - q.y() * (s.top_radius - s.radius);
  const bool is_inside = q.y() > 0 && q.y() < s.height && flank < 0;
  return is_inside ? -distance : distance;
}

double triangle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const bool is_over = n.squaredNorm() > 0 && n.dot((b - a).cross(p - a)) >= 0 &&
                       n.dot((c - b).cross(p - b)) >= 0 && n.dot((a - c).cross(p - c)) >= 0;
  if (is_over) return std::abs(n.normalized().dot(p - a));
  const auto edge = [&p](const Vec3& u, const Vec3& v) {
    const double length2 = (v - u).squaredNorm();
    const double t = length2 > 0 ? std::clamp((p - u).dot(v - u) / length2, 0.0, 1.0) : 0.0;
    return (p - u - (v - u) * t).norm();
  };
  return std::min({edge(a, b), edge(b, c), edge(c, a)});
}

/// Solid angle of a triangle seen from the origin (Van Oosterom and Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  const double denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return 2 * std::atan2(a.dot(b.cross(c)), denominator);
}

double polyhedron_distance(const Mesh& mesh, const Vec3& p) {
  double distance = kInfinity;
  double winding = 0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const Vec3 a = mesh.corner(t, 0);
    const Vec3 b = mesh.corner(t, 1);
    const Vec3 c = mesh.corner(t, 2);
    distance = std::min(distance, triangle_distance(p, a, b, c));
    winding += solid_angle(a - p, b - p, c - p);
  }
  return winding > 2 * kPi ? -distance : distance;
}

/// Half-extents of a disc of radius 1 with the given normal.
Vec3 disc_extent(const Vec3& normal) {
  return (Vec3::Ones() - normal.cwiseProduct(normal)).cwiseMax(0).cwiseSqrt();
}

Box3 around(const Vec3& center, const Vec3& half) {
  Box3 box;
  box.extend(center - half);
  box.extend(center + half);
  return box;
}

double canonical_distance(const Literal& s, const Vec3& p) {
  switch (s.kind) {
    case SolidKind::Box:
      return box_distance(p, s.size);
    case SolidKind::Cylinder:
      return frustum_distance(s, p);
    case SolidKind::Prism:
      return prism_distance(s, p);
    case SolidKind::Sphere:
      return p.norm() - s.radius;
    case SolidKind::Torus:
      return std::hypot(std::hypot(p.x(), p.y()) - s.major_radius, p.z()) - s.radius;
    case SolidKind::Polyhedron:
      if (s.polyhedron_query) return s.polyhedron_query->signed_distance(p);
      return s.polyhedron ? polyhedron_distance(*s.polyhedron, p) : kInfinity;
  }
  return kInfinity;
}

bool canonical_contains(const Literal& s, const Vec3& p) {
  if (s.kind == SolidKind::Box) {
    return (((p - s.size / 2).cwiseAbs() - s.size / 2).array() < 0).all();
  }
  if (s.kind == SolidKind::Cylinder && s.radius == s.top_radius) {
    return std::abs(p.z() - s.height / 2) - s.height / 2 < 0 &&
           std::sqrt(p.x() * p.x() + p.y() * p.y()) - s.radius < 0;
  }
  return canonical_distance(s, p) < 0;
}

/// Half-extents of a unit disc whose axes are two columns of `map`.
Vec3 disc_extent(const Mat3& map) {
  return (map.col(0).cwiseAbs2() + map.col(1).cwiseAbs2()).cwiseSqrt();
}

/// The bounds of a prism's corners in space.
Box3 prism_bounds(const Literal& s) {
  Box3 box;
  for (int k = 0; k < s.sides; ++k) {
    const Vec2 corner = prism_corner(s, k);
    for (const double z : {0.0, s.height}) {
      box.extend(s.to_world(Vec3(corner.x(), corner.y(), z)));
    }
  }
  return box;
}

/// The bounds of a stretched literal: those of discs and balls under a linear map.
Box3 stretched_bounds(const Literal& s) {
  const Mat3 map = s.rotation * s.stretch->matrix;
  const Vec3 center = s.to_world(Vec3::Zero());
  const Vec3 ball = map.cwiseAbs2().rowwise().sum().cwiseSqrt();
  Box3 box;
  switch (s.kind) {
    case SolidKind::Box:
      for (int k = 0; k < 8; ++k) {
        const Vec3 corner((k & 1) ? s.size.x() : 0, (k & 2) ? s.size.y() : 0,
                          (k & 4) ? s.size.z() : 0);
        box.extend(s.to_world(corner));
      }
      break;
    case SolidKind::Cylinder: {
      box = around(center, disc_extent(map) * s.radius);
      const Vec3 top = s.to_world(Vec3::UnitZ() * s.height);
      const Box3 end = around(top, disc_extent(map) * s.top_radius);
      box.extend(end.lo);
      box.extend(end.hi);
      break;
    }
    case SolidKind::Prism:
      return prism_bounds(s);
    case SolidKind::Sphere:
      box = around(center, ball * s.radius);
      break;
    case SolidKind::Torus:
      box = around(center, disc_extent(map) * s.major_radius + ball * s.radius);
      break;
    case SolidKind::Polyhedron:
      if (!s.polyhedron) break;
      for (const Vec3& p : s.polyhedron->vertices) box.extend(s.to_world(p));
      break;
  }
  return box;
}

}  // namespace

Stretch Stretch::of(const Mat3& matrix) {
  const Mat3 inverse = matrix.inverse();
  return {matrix, inverse, 1 / inverse.norm()};
}

double Literal::signed_distance(const Vec3& x) const {
  const double distance = canonical_distance(*this, to_local(x));
  return stretch ? distance * stretch->least : distance;
}

bool Literal::contains(const Vec3& x) const { return canonical_contains(*this, to_local(x)); }

Box3 Literal::bounds() const {
  if (stretch) return stretched_bounds(*this);
  const Vec3 center = rotation * origin;
  const Vec3 axis = rotation.col(2);
  Box3 box;
  switch (kind) {
    case SolidKind::Box:
      for (int k = 0; k < 8; ++k) {
        const Vec3 corner((k & 1) ? size.x() : 0, (k & 2) ? size.y() : 0, (k & 4) ? size.z() : 0);
        box.extend(to_world(corner));
      }
      break;
    case SolidKind::Cylinder: {
      box = around(center, disc_extent(axis) * radius);
      const Box3 top = around(center + axis * height, disc_extent(axis) * top_radius);
      box.extend(top.lo);
      box.extend(top.hi);
      break;
    }
    case SolidKind::Prism:
      return prism_bounds(*this);
    case SolidKind::Sphere:
      box = around(center, Vec3::Constant(radius));
      break;
    case SolidKind::Torus:
      box = around(center, disc_extent(axis) * major_radius + Vec3::Constant(radius));
      break;
    case SolidKind::Polyhedron:
      if (!polyhedron) break;
      for (const Vec3& p : polyhedron->vertices) box.extend(to_world(p));
      break;
  }
  return box;
}

Literal polyhedron_literal(std::shared_ptr<const Mesh> mesh) {
  Literal s;
  s.kind = SolidKind::Polyhedron;
  s.polyhedron = std::move(mesh);
  s.polyhedron_query = std::make_shared<const MeshQuery>(s.polyhedron);
  return s;
}

const char* name_of(SolidKind kind) {
  switch (kind) {
    case SolidKind::Box:
      return "cube";
    case SolidKind::Cylinder:
      return "cylinder";
    case SolidKind::Prism:
      return "prism";
    case SolidKind::Sphere:
      return "sphere";
    case SolidKind::Torus:
      return "torus";
    case SolidKind::Polyhedron:
      return "polyhedron";
  }
  return "solid";
}

}  // namespace hewn
