#include "core/csg/boundary/boundary_patch.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/csg/prism.h"

namespace hewn {
namespace {

constexpr int kUpper = 1;    // of a part's number
constexpr int kTop = 2 * 2;  // the z axis' parts: the bottom, and the top one after it

/// Powers of two, so that halving the unit square never cuts a facet but at its border.
int facets_per_turn(double radius, double deflection) {
  const double wanted = kPi / std::sqrt(2 * deflection / std::max(radius, deflection));
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::clamp(wanted, 16.0, 128.0))));
}

Vec3 on_circle(double angle_rad, double radius, double z) {
  return {radius * std::cos(angle_rad), radius * std::sin(angle_rad), z};
}

/// Half the angle around the tube that bounds the solid: a spindle torus is folded into itself.
double tube_reach(const Literal& torus) {
  return torus.radius <= torus.major_radius ? kPi : std::acos(-torus.major_radius / torus.radius);
}

Vec3 lerp(const Vec3& a, const Vec3& b, double t) { return a + t * (b - a); }

Vec3 prism_corner_at(const Literal& s, int k, double z) {
  const Vec2 corner = prism_corner(s, k);
  return {corner.x(), corner.y(), z};
}

PatchPoint local_point(const Literal& s, const BoundaryPatch& patch, double u, double v) {
  const double turn = 2 * kPi * u;
  const bool is_upper = (patch.part & kUpper) != 0;
  switch (patch.shape) {
    case PatchShape::BoxSide: {
      const int axis = patch.part / 2;
      Vec3 p = Vec3::Zero();
      p[axis] = is_upper ? s.size[axis] : 0;
      p[(axis + 1) % 3] = u * s.size[(axis + 1) % 3];
      p[(axis + 2) % 3] = v * s.size[(axis + 2) % 3];
      return {p, is_upper ? Vec3(Vec3::Unit(axis)) : Vec3(-Vec3::Unit(axis))};
    }
    case PatchShape::Side:
      return {on_circle(turn, s.radius + v * (s.top_radius - s.radius), v * s.height),
              on_circle(turn, s.height, s.radius - s.top_radius).normalized()};
    case PatchShape::Cap:
      return {on_circle(turn, v * (is_upper ? s.top_radius : s.radius), is_upper ? s.height : 0),
              is_upper ? Vec3(Vec3::UnitZ()) : Vec3(-Vec3::UnitZ())};
    case PatchShape::PrismSide: {
      const Vec2 normal = prism_side_normal(s, patch.part);
      return {lerp(prism_corner_at(s, patch.part, v * s.height),
                   prism_corner_at(s, patch.part + 1, v * s.height), u),
              {normal.x(), normal.y(), 0}};
    }
    case PatchShape::PrismCap: {
      const double z = is_upper ? s.height : 0;
      const Vec3 rim =
          lerp(prism_corner_at(s, patch.part / 2, z), prism_corner_at(s, patch.part / 2 + 1, z), u);
      return {lerp({0, 0, z}, rim, v), is_upper ? Vec3(Vec3::UnitZ()) : Vec3(-Vec3::UnitZ())};
    }
    case PatchShape::Sphere: {
      const double latitude = kPi * (v - 0.5);
      const Vec3 n = on_circle(turn, std::cos(latitude), std::sin(latitude));
      return {s.radius * n, n};
    }
    case PatchShape::Torus: {
      const double around = tube_reach(s) * (2 * v - 1);
      const Vec3 n = on_circle(turn, std::cos(around), std::sin(around));
      return {on_circle(turn, s.major_radius, 0) + s.radius * n, n};
    }
    case PatchShape::Facet: {
      const Mesh& mesh = *s.polyhedron;
      const Vec3 far = lerp(mesh.corner(patch.part, 1), mesh.corner(patch.part, 2), u);
      return {lerp(mesh.corner(patch.part, 0), far, v), mesh.normals[patch.part]};
    }
  }
  return {};
}

/// Lists the patches of one literal.
class PatchLister {
 public:
  PatchLister(const Literal& literal, int index, double deflection,
              std::vector<BoundaryPatch>& patches)
      : literal_(literal), index_(index), deflection_(deflection), patches_(patches) {
    if (literal.stretch) scale_ = literal.stretch->matrix.norm();
  }

  void list() {
    switch (literal_.kind) {
      case SolidKind::Box:
        list_box();
        break;
      case SolidKind::Cylinder:
        list_cylinder();
        break;
      case SolidKind::Prism:
        list_prism();
        break;
      case SolidKind::Sphere:
        list_sphere();
        break;
      case SolidKind::Torus:
        list_torus();
        break;
      case SolidKind::Polyhedron:
        list_polyhedron();
        break;
    }
  }

 private:
  BoundaryPatch& add(PatchShape shape, int part, double u_length, double v_length) {
    BoundaryPatch patch;
    patch.shape = shape;
    patch.literal = index_;
    patch.part = part;
    patch.is_orthogonal =
        !literal_.stretch && shape != PatchShape::PrismCap && shape != PatchShape::Facet;
    patch.u_length = scale_ * u_length;
    patch.v_length = scale_ * v_length;
    patches_.push_back(patch);
    return patches_.back();
  }

  static void end_at(BoundaryPatch& patch, std::initializer_list<int> ends) {
    for (const int e : ends) patch.ends[e] = true;
  }

  int facets(double radius) const { return facets_per_turn(scale_ * radius, deflection_); }

  void list_box() {
    for (int part = 0; part < 6; ++part) {
      const int axis = part / 2;
      end_at(add(PatchShape::BoxSide, part, literal_.size[(axis + 1) % 3],
                 literal_.size[(axis + 2) % 3]),
             {0, 1, 2, 3});
    }
  }

  void list_cylinder() {
    const double widest = std::max(literal_.radius, literal_.top_radius);
    const int count = facets(widest);
    BoundaryPatch& side = add(PatchShape::Side, 0, 2 * kPi * widest,
                              std::hypot(literal_.height, literal_.radius - literal_.top_radius));
    side.is_flat = false;
    side.u_facets = count;
    end_at(side, {2, 3});
    for (const bool is_upper : {false, true}) {
      const double radius = is_upper ? literal_.top_radius : literal_.radius;
      if (radius <= 0) continue;
      BoundaryPatch& cap =
          add(PatchShape::Cap, kTop + (is_upper ? 1 : 0), 2 * kPi * radius, radius);
      cap.u_facets = count;
      end_at(cap, {3});
    }
  }

  void list_prism() {
    const double side = 2 * literal_.radius * std::tan(kPi / literal_.sides);
    for (int k = 0; k < literal_.sides; ++k) {
      end_at(add(PatchShape::PrismSide, k, side, literal_.height), {0, 1, 2, 3});
      for (const int upper : {0, 1}) {
        end_at(add(PatchShape::PrismCap, 2 * k + upper, side, circumradius(literal_)), {3});
      }
    }
  }

  void list_sphere() {
    BoundaryPatch& patch =
        add(PatchShape::Sphere, 0, 2 * kPi * literal_.radius, kPi * literal_.radius);
    patch.is_flat = false;
    patch.u_facets = facets(literal_.radius);
    patch.v_facets = patch.u_facets / 2;
  }

  void list_torus() {
    const double outer = literal_.major_radius + literal_.radius;
    BoundaryPatch& patch = add(PatchShape::Torus, 0, 2 * kPi * outer, 2 * kPi * literal_.radius);
    patch.is_flat = false;
    patch.u_facets = facets(outer);
    patch.v_facets = facets(literal_.radius);
  }

  void list_polyhedron() {
    const Mesh& mesh = *literal_.polyhedron;
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      if (mesh.areas[t] <= 0) continue;
      const Vec3 a = mesh.corner(t, 0);
      const Vec3 b = mesh.corner(t, 1);
      const Vec3 c = mesh.corner(t, 2);
      end_at(add(PatchShape::Facet, t, (c - b).norm(), std::max((b - a).norm(), (c - a).norm())),
             {0, 1, 3});
    }
  }

  const Literal& literal_;
  int index_;
  double deflection_;
  std::vector<BoundaryPatch>& patches_;
  double scale_ = 1;  ///< no length grows by more
};

}  // namespace

PatchPoint point_on(const Literal& literal, const BoundaryPatch& patch, double u, double v) {
  const PatchPoint local = local_point(literal, patch, u, v);
  const Vec3 normal =
      literal.stretch ? Vec3(literal.stretch->inverse.transpose() * local.normal) : local.normal;
  return {literal.to_world(local.position), (literal.rotation * normal).normalized()};
}

std::vector<BoundaryPatch> boundary_patches(const Tree& tree, double deflection) {
  std::vector<BoundaryPatch> patches;
  for (std::size_t l = 0; l < tree.literals.size(); ++l) {
    PatchLister(tree.literals[l], static_cast<int>(l), deflection, patches).list();
  }
  return patches;
}

}  // namespace hewn
