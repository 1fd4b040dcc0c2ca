#include "core/csg/tree_inside.h"

namespace hewn {

TreeInside::TreeInside(const Tree& tree) : tree_(&tree), program_(branching_program(tree)) {
  for (const Literal& s : tree.literals) bounds_.emplace_back(s);
}

bool TreeInside::contains(const Vec3& x) const {
  return program_.run(
      [&](std::uint32_t k) { return literal_contains(tree_->literals[k], bounds_[k], x); });
}

}  // namespace hewn
