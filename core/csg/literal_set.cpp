#include "core/csg/literal_set.h"

namespace hewn {

bool is_same_solid(const Literal& a, const Literal& b) {
  if (a.kind != b.kind || a.stretch.has_value() != b.stretch.has_value()) return false;
  if (a.stretch && a.stretch->matrix != b.stretch->matrix) return false;
  const bool is_ball = a.kind == SolidKind::Sphere && !a.stretch;
  if (is_ball) {
    return a.radius == b.radius && a.to_world(Vec3::Zero()) == b.to_world(Vec3::Zero());
  }
  if (a.origin != b.origin || a.rotation != b.rotation) return false;
  switch (a.kind) {
    case SolidKind::Box:
      return a.size == b.size;
    case SolidKind::Cylinder:
      return a.height == b.height && a.radius == b.radius && a.top_radius == b.top_radius;
    case SolidKind::Prism:
      return a.sides == b.sides && a.height == b.height && a.radius == b.radius;
    case SolidKind::Sphere:
      return a.radius == b.radius;
    case SolidKind::Torus:
      return a.radius == b.radius && a.major_radius == b.major_radius;
    case SolidKind::Polyhedron:
      break;
  }
  if (a.polyhedron == b.polyhedron) return true;
  return a.polyhedron && b.polyhedron && a.polyhedron->vertices == b.polyhedron->vertices &&
         a.polyhedron->triangles == b.polyhedron->triangles;
}

std::vector<int> LiteralSet::add(const Tree& tree) {
  std::vector<int> index;
  for (const Literal& s : tree.literals) {
    int found = -1;
    for (std::size_t k = 0; k < literals_.size() && found < 0; ++k) {
      if (is_same_solid(literals_[k], s)) found = static_cast<int>(k);
    }
    if (found < 0) {
      found = static_cast<int>(literals_.size());
      literals_.push_back(s);
    }
    index.push_back(found);
  }
  return index;
}

Box3 bounds_of_literals(const Tree& tree) {
  Box3 all;
  for (const Literal& literal : tree.literals) {
    const Box3 box = literal.bounds();
    if (box.is_empty()) continue;
    all.extend(box.lo);
    all.extend(box.hi);
  }
  return all;
}

double scale_of(const Tree& tree) {
  double diagonal = tree.bounds().diagonal();
  if (std::isfinite(diagonal) && diagonal > 0) return diagonal;
  diagonal = bounds_of_literals(tree).diagonal();
  return diagonal > 0 ? diagonal : 1;
}

}  // namespace hewn
