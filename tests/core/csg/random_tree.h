#pragma once
/// Random literals and trees for property tests.
#include <vector>

#include "core/base/rng.h"
#include "core/csg/tree.h"

namespace hewn::testing {

inline Vec3 random_point(Rng& rng, double half) {
  Vec3 p;
  for (double& c : p) c = rng.uniform(-half, half);
  return p;
}

inline Mat3 random_rotation(Rng& rng) {
  const double a = rng.uniform(-kPi, kPi);
  const double b = rng.uniform(-kPi, kPi);
  const double c = rng.uniform(-kPi, kPi);
  return (Eigen::AngleAxisd(c, Vec3::UnitZ()) * Eigen::AngleAxisd(b, Vec3::UnitY()) *
          Eigen::AngleAxisd(a, Vec3::UnitX()))
      .toRotationMatrix();
}

inline Mesh tetrahedron(double edge) {
  return make_mesh({{0, 0, 0}, {edge, 0, 0}, {0, edge, 0}, {0, 0, edge}},
                   {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

/// A literal of about unit size within two units of the origin, scaled by `scale`. Half of them
/// are axis-aligned.
inline Literal random_literal(Rng& rng, double scale = 1) {
  constexpr SolidKind kKinds[] = {SolidKind::Box,        SolidKind::Box,    SolidKind::Cylinder,
                                  SolidKind::Cylinder,   SolidKind::Sphere, SolidKind::Torus,
                                  SolidKind::Polyhedron, SolidKind::Prism};
  Literal s;
  s.kind = kKinds[rng.below(std::size(kKinds))];
  if (rng.coin()) s.rotation = random_rotation(rng);
  s.origin = random_point(rng, 1) * scale;
  s.size = (random_point(rng, 0.75) + Vec3::Constant(1)) * scale;
  s.height = rng.uniform(0.3, 1.5) * scale;
  s.radius = rng.uniform(0.2, 0.8) * scale;
  const bool is_straight = rng.coin();
  s.top_radius = is_straight ? s.radius : rng.uniform(0.0, 0.8) * scale;
  s.major_radius = rng.uniform(0.3, 1.0) * scale;
  s.sides = 3 + static_cast<int>(rng.below(6));
  if (s.kind == SolidKind::Polyhedron) {
    const double edge = rng.uniform(0.5, 1.5) * scale;
    const Literal solid = polyhedron_literal(std::make_shared<const Mesh>(tetrahedron(edge)));
    s.polyhedron = solid.polyhedron;
    s.polyhedron_query = solid.polyhedron_query;
  }
  return s;
}

struct TreeShape {
  int depth = 4;
  bool has_complements = false;
  bool has_names = false;
  double scale = 1;
};

inline int add_random_node(Tree& tree, Rng& rng, const TreeShape& shape, int depth) {
  if (depth == 0 || rng.below(4) == 0) return tree.add_literal(random_literal(rng, shape.scale));
  constexpr Op kOps[] = {Op::Union, Op::Intersection, Op::Difference, Op::Complement};
  const Op op = kOps[rng.below(shape.has_complements ? 4 : 3)];
  const std::size_t count = op == Op::Complement ? 1 : 1 + rng.below(3);
  std::vector<int> children;
  for (std::size_t i = 0; i < count; ++i) {
    children.push_back(add_random_node(tree, rng, shape, depth - 1));
  }
  const bool is_named = shape.has_names && rng.below(4) == 0;
  return tree.add_node(op, std::move(children), is_named ? "part" : "");
}

inline Tree random_tree(Rng& rng, const TreeShape& shape) {
  Tree tree;
  tree.root = add_random_node(tree, rng, shape, shape.depth);
  return tree;
}

}  // namespace hewn::testing
