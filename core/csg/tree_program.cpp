#include "core/csg/tree_program.h"

#include <algorithm>

#include <fmt/format.h>

namespace hewn {
namespace {

ProgramLiteral encode_literal(const Literal& s, const Vec3& origin) {
  // local = inverse (rotation^T x - s.origin), with x = y + origin.
  Mat3 map = s.rotation.transpose();
  Vec3 offset = map * origin - s.origin;
  if (s.stretch) {
    map = s.stretch->inverse * map;
    offset = s.stretch->inverse * offset;
  }
  ProgramLiteral out;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      out.to_local[4 * row + column] = static_cast<float>(map(row, column));
    }
    out.to_local[4 * row + 3] = static_cast<float>(offset[row]);
  }
  Vec3 shape = Vec3::Zero();
  switch (s.kind) {
    case SolidKind::Box:
      shape = s.size;
      break;
    case SolidKind::Cylinder:
      shape = Vec3(s.radius, s.top_radius, s.height);
      break;
    case SolidKind::Prism:
      shape = Vec3(s.radius, s.height, s.sides);
      break;
    case SolidKind::Sphere:
      shape = Vec3(s.radius, 0, 0);
      break;
    case SolidKind::Torus:
      shape = Vec3(s.major_radius, s.radius, 0);
      break;
    case SolidKind::Polyhedron:
      break;
  }
  out.shape[0] = static_cast<float>(s.kind);
  for (int k = 0; k < 3; ++k) out.shape[k + 1] = static_cast<float>(shape[k]);
  return out;
}

/// Why a tree cannot be a program; empty: it can.
std::string obstacle(const Tree& tree) {
  if (tree.is_empty()) return "the tree is empty";
  int stretches = 0;
  for (const Literal& s : tree.literals) {
    if (s.kind == SolidKind::Polyhedron) return "it holds a polyhedron";
    if (s.kind == SolidKind::Prism && s.sides > kMostProgramSides) {
      return fmt::format("a prism has {} sides, more than {}", s.sides, kMostProgramSides);
    }
    stretches += s.kind == SolidKind::Torus ? 2 : 1;
  }
  if (stretches > kMostStretches) {
    return fmt::format("it has {} literals, more than {}", tree.literals.size(), kMostStretches);
  }
  return {};
}

}  // namespace

Result<TreeProgram> encode_tree(const Tree& tree) {
  if (const std::string why = obstacle(tree); !why.empty()) {
    return Error{ErrorCode::InvalidArgument, why};
  }
  const Box3 bounds = tree.bounds();
  if (bounds.is_empty()) return Error{ErrorCode::InvalidArgument, "the solid is empty"};
  if (!bounds.lo.allFinite() || !bounds.hi.allFinite()) {
    return Error{ErrorCode::InvalidArgument, "the solid is unbounded"};
  }
  TreeProgram out;
  static_cast<BranchingProgram&>(out) = branching_program(tree);
  out.bounds = bounds;
  out.origin = bounds.center();
  for (const Literal& literal : tree.literals) {
    out.shown.insert(out.shown.end(), 6, static_cast<std::int32_t>(out.literals.size()));
    out.literals.push_back(encode_literal(literal, out.origin));
    out.stretches += literal.kind == SolidKind::Torus ? 2 : 1;
  }
  return out;
}

}  // namespace hewn
