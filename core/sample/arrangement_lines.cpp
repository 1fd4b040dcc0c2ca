#include "core/sample/arrangement_lines.h"

#include <algorithm>
#include <cmath>

#include "core/csg/prism.h"

namespace hewn {
namespace {

/// Writes probes of one literal in its local coordinates and moves them into space.
class ProbeMaker {
 public:
  ProbeMaker(const Literal& literal, const ProbeOptions& options, Rng& rng)
      : s_(literal),
        offset_(options.offset),
        lines_(options.lines_per_face),
        circles_(options.circles_per_face),
        has_edges_(options.has_edges),
        rng_(rng) {
    // Local lengths of a stretched literal are not those of space.
    if (s_.stretch) offset_ /= std::max(1e-12, s_.stretch->matrix.norm());
  }

  Probes run() {
    switch (s_.kind) {
      case SolidKind::Box:
        box_faces();
        if (has_edges_) box_edges();
        break;
      case SolidKind::Cylinder:
        flank();
        caps();
        break;
      case SolidKind::Prism:
        if (has_edges_) polyhedron(prism_mesh(s_));
        break;
      case SolidKind::Sphere:
        for (const double side : {-1.0, 1.0}) sphere(s_.radius + side * offset_);
        break;
      case SolidKind::Torus:
        for (const double side : {-1.0, 1.0}) torus(s_.radius + side * offset_);
        break;
      case SolidKind::Polyhedron:
        if (has_edges_ && s_.polyhedron) polyhedron(*s_.polyhedron);
        break;
    }
    return std::move(out_);
  }

 private:
  static constexpr std::size_t kMostFacets = 300;

  void line(const Vec3& a, const Vec3& b) {
    const Vec3 from = s_.to_world(a);
    const Vec3 d = s_.to_world(b) - from;
    const double length = d.norm();
    if (length > 0) out_.lines.push_back({from, d / length});
  }

  void circle(const Vec3& center, const Vec3& u, const Vec3& w) {
    const Vec3 c = s_.to_world(center);
    out_.circles.push_back({c, s_.to_world(center + u) - c, s_.to_world(center + w) - c});
  }

  /// Half of the lines run along the face's own axes, where other boxes' edges are.
  void box_faces() {
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 4 * lines_; ++k) {
        const double side = k % 2 == 0 ? offset_ : -offset_;
        Vec3 a;
        Vec3 b;
        for (int i = 0; i < 3; ++i) {
          a[i] = rng_.uniform(0, s_.size[i]);
          b[i] = rng_.uniform(0, s_.size[i]);
        }
        if (k % 8 < 2) b[(axis + 1) % 3] = a[(axis + 1) % 3];
        if (k % 8 >= 2 && k % 8 < 4) b[(axis + 2) % 3] = a[(axis + 2) % 3];
        a[axis] = b[axis] = (k / 2) % 2 == 0 ? side : s_.size[axis] + side;
        line(a, b);
      }
    }
  }

  void box_edges() {
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      for (int k = 0; k < 16; ++k) {
        Vec3 a = Vec3::Zero();
        a[u] = ((k & 1) ? s_.size[u] : 0) + ((k & 2) ? offset_ : -offset_);
        a[v] = ((k & 4) ? s_.size[v] : 0) + ((k & 8) ? offset_ : -offset_);
        line(a, a + Vec3::Unit(axis) * s_.size[axis]);
      }
    }
  }

  double radius_at(double z) const {
    return s_.radius + (s_.top_radius - s_.radius) * z / s_.height;
  }

  void flank() {
    // Along the normal of the flank, measured across the axis.
    const double slope = (s_.top_radius - s_.radius) / s_.height;
    const double across = offset_ * std::sqrt(1 + slope * slope);
    for (int k = 0; k < 2 * lines_; ++k) {
      const double angle = rng_.uniform(0, 2 * kPi);
      const double side = k % 2 == 0 ? across : -across;
      const Vec3 ray(std::cos(angle), std::sin(angle), 0);
      const Vec3 top = ray * (s_.top_radius + side) + Vec3::UnitZ() * s_.height;
      line(ray * (s_.radius + side), top);
    }
    for (int k = 0; k < 2 * circles_; ++k) {
      const double z = rng_.uniform(0, s_.height);
      ring(z, radius_at(z) + (k % 2 == 0 ? across : -across));
    }
    for (int k = 0; k < (has_edges_ ? 8 : 0); ++k) {
      const double z = ((k & 1) ? s_.height : 0) + ((k & 2) ? offset_ : -offset_);
      ring(z, radius_at(z) + ((k & 4) ? across : -across));
    }
  }

  void ring(double z, double r) {
    if (r > 0) circle(Vec3(0, 0, z), Vec3(r, 0, 0), Vec3(0, r, 0));
  }

  void caps() {
    for (int k = 0; k < 4 * lines_; ++k) {
      const bool is_top = (k & 1) != 0;
      const double z = (is_top ? s_.height : 0) + ((k & 2) ? offset_ : -offset_);
      const double r = is_top ? s_.top_radius : s_.radius;
      if (r <= 0) continue;
      const double from = rng_.uniform(0, 2 * kPi);
      const double to = rng_.uniform(0, 2 * kPi);
      line(Vec3(r * std::cos(from), r * std::sin(from), z),
           Vec3(r * std::cos(to), r * std::sin(to), z));
    }
  }

  Vec3 random_direction() {
    const double z = rng_.uniform(-1, 1);
    const double angle = rng_.uniform(0, 2 * kPi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

  void sphere(double r) {
    const int great = has_edges_ ? 3 : 0;
    for (int k = 0; k < great + 2 * circles_; ++k) {
      const Vec3 axis = k < great ? Vec3(Vec3::Unit(k)) : random_direction();
      const double height = k < great ? 0 : rng_.uniform(-0.95, 0.95);
      const Tangents t = tangents(axis);
      const double across = r * std::sqrt(1 - height * height);
      circle(axis * (r * height), t.u * across, t.w * across);
    }
  }

  void torus(double r) {
    for (int k = 0; k < 2 * circles_; ++k) {
      const double around = rng_.uniform(0, 2 * kPi);
      ring(r * std::sin(around), s_.major_radius + r * std::cos(around));
      const double along = rng_.uniform(0, 2 * kPi);
      const Vec3 ray(std::cos(along), std::sin(along), 0);
      circle(ray * s_.major_radius, ray * r, Vec3::UnitZ() * r);
    }
  }

  void polyhedron(const Mesh& mesh) {
    const std::size_t step = 1 + mesh.triangles.size() / kMostFacets;
    for (std::size_t t = rng_.below(step); t < mesh.triangles.size(); t += step) {
      const int triangle = static_cast<int>(t);
      if (mesh.areas[t] <= 0) continue;
      const Vec3 n = mesh.normals[t];
      for (int k = 0; k < 3; ++k) {
        const Vec3 a = mesh.corner(triangle, k);
        const Vec3 b = mesh.corner(triangle, (k + 1) % 3);
        const Vec3 across = n.cross(b - a).normalized();
        for (const double side : {-offset_, offset_}) {
          line(a + side * n + offset_ * across, b + side * n + offset_ * across);
          line(a + side * n - offset_ * across, b + side * n - offset_ * across);
          const Vec3 c = mesh.centroid(triangle);
          line(a + side * n, c + side * n);
        }
      }
    }
  }

  const Literal& s_;
  double offset_;
  int lines_, circles_;
  bool has_edges_;
  Rng& rng_;
  Probes out_;
};

}  // namespace

Probes probes_of(const Literal& literal, const ProbeOptions& options, Rng& rng) {
  return ProbeMaker(literal, options, rng).run();
}

std::vector<FacePlane> planes_of(const Literal& s) {
  std::vector<FacePlane> planes;
  const Mat3 normals = s.stretch ? Mat3(s.rotation * s.stretch->inverse.transpose()) : s.rotation;
  const auto add = [&](int axis, const Vec3& local) {
    planes.push_back({s.to_world(local), normals.col(axis).normalized()});
  };
  if (s.kind == SolidKind::Box) {
    for (int axis = 0; axis < 3; ++axis) {
      add(axis, Vec3::Zero());
      add(axis, s.size);
    }
  }
  if (s.kind == SolidKind::Prism) {
    const Mesh mesh = prism_mesh(s);
    for (int k = 0; k < s.sides; ++k) {
      const Vec2 n = prism_side_normal(s, k);
      const Vec3 normal = (normals * Vec3(n.x(), n.y(), 0)).normalized();
      planes.push_back({s.to_world(mesh.vertices[k]), normal});
    }
  }
  if (s.kind == SolidKind::Cylinder || s.kind == SolidKind::Prism) {
    add(2, Vec3::Zero());
    add(2, Vec3::UnitZ() * s.height);
  }
  return planes;
}

}  // namespace hewn
