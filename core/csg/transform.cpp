// Literals under affine maps.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/csg/literal.h"
#include "core/mesh/query.h"

namespace hewn {
namespace {

/// Lengths and angles that differ by less are the same; above the rounding of a few matrices.
constexpr double kSame = 1e-12;

bool are_orthogonal(const Vec3& a, const Vec3& b) {
  return std::abs(a.dot(b)) <= kSame * a.norm() * b.norm();
}

bool are_same(double a, double b) { return std::abs(a - b) <= kSame * std::max(a, b); }

/// An orthogonal basis with the length of each axis; right-handed.
struct ScaledFrame {
  Mat3 rotation = Mat3::Identity();
  Vec3 scale = Vec3::Ones();
  bool is_mirrored = false;  ///< the x axis was turned round to make it right-handed
};

/// Requires: orthogonal columns.
ScaledFrame frame_of(const Mat3& m) {
  ScaledFrame f;
  for (int k = 0; k < 3; ++k) {
    f.scale[k] = m.col(k).norm();
    f.rotation.col(k) = m.col(k) / f.scale[k];
  }
  f.is_mirrored = m.determinant() < 0;
  if (f.is_mirrored) f.rotation.col(0) = -f.rotation.col(0);
  return f;
}

/// What a literal's own fields can take up.
bool fits(const Literal& s, const Mat3& m) {
  const bool is_upright = are_orthogonal(m.col(0), m.col(2)) && are_orthogonal(m.col(1), m.col(2));
  if (!is_upright || !are_orthogonal(m.col(0), m.col(1))) return false;
  if (s.kind == SolidKind::Box) return true;
  if (!are_same(m.col(0).norm(), m.col(1).norm())) return false;
  const bool is_prismatic = s.kind == SolidKind::Cylinder || s.kind == SolidKind::Prism;
  return is_prismatic || are_same(m.col(0).norm(), m.col(2).norm());
}

void put_into_fields(Literal& s, const Mat3& m, const Vec3& at) {
  ScaledFrame f = frame_of(m);
  // A prism is symmetric about its local x axis, so it is y that a mirror may turn round.
  if (f.is_mirrored && s.kind == SolidKind::Prism) f.rotation.leftCols<2>() *= -1;
  s.stretch.reset();
  s.rotation = f.rotation;
  s.origin = f.rotation.transpose() * at;
  s.size = s.size.cwiseProduct(f.scale);
  // A box is not symmetric about the planes of its frame; the round solids are.
  if (f.is_mirrored && s.kind == SolidKind::Box) s.origin.x() -= s.size.x();
  if (f.is_mirrored) s.facets.phase_rad = kPi - s.facets.phase_rad;
  s.height *= f.scale.z();
  s.radius *= f.scale.x();
  s.top_radius *= f.scale.x();
  s.major_radius *= f.scale.x();
}

void move_polyhedron(Literal& s, const Mat3& m, const Vec3& at) {
  std::vector<Vec3> vertices;
  vertices.reserve(s.polyhedron->vertices.size());
  for (const Vec3& v : s.polyhedron->vertices) vertices.emplace_back(m * v + at);
  std::vector<Triangle> triangles = s.polyhedron->triangles;
  if (m.determinant() < 0) {
    for (Triangle& t : triangles) std::swap(t[1], t[2]);
  }
  const auto mesh =
      std::make_shared<const Mesh>(make_mesh(std::move(vertices), std::move(triangles)));
  s = polyhedron_literal(mesh);
}

}  // namespace

Literal transformed(const Literal& literal, const Affine3& map) {
  Literal s = literal;
  Mat3 m = map.linear() * s.rotation;
  if (s.stretch) m *= s.stretch->matrix;
  const Vec3 at = map * s.to_world(Vec3::Zero());
  if (s.kind == SolidKind::Polyhedron) {
    if (s.polyhedron) move_polyhedron(s, m, at);
    return s;
  }
  if (fits(s, m)) {
    put_into_fields(s, m, at);
    return s;
  }
  s.rotation.setIdentity();
  s.origin = at;
  s.stretch = Stretch::of(m);
  s.facets = {};
  return s;
}

}  // namespace hewn
