#include "core/csg/tree_inside.h"

#include <algorithm>

namespace hewn {

TreeInside::TreeInside(const Tree& tree) : tree_(&tree) {
  for (const Literal& s : tree.literals) bounds_.emplace_back(s);
}

bool TreeInside::contains(int node, const Vec3& x) const {
  const Node& n = tree_->nodes[static_cast<std::size_t>(node)];
  const auto holds = [&](int child) { return contains(child, x); };
  switch (n.op) {
    case Op::Literal: {
      const auto k = static_cast<std::size_t>(n.literal);
      return literal_contains(tree_->literals[k], bounds_[k], x);
    }
    case Op::Union:
      return std::any_of(n.children.begin(), n.children.end(), holds);
    case Op::Intersection:
      return !n.children.empty() && std::all_of(n.children.begin(), n.children.end(), holds);
    case Op::Difference:
      return !n.children.empty() && holds(n.children.front()) &&
             std::none_of(n.children.begin() + 1, n.children.end(), holds);
    case Op::Complement:
      return n.children.empty() || !holds(n.children.front());
  }
  return false;
}

}  // namespace hewn
