#pragma once
/// Literals without repetitions.
#include <vector>

#include "core/csg/tree.h"

namespace hewn {

/// The same solid with the same numbers; facets do not count.
bool is_same_solid(const Literal& a, const Literal& b);

/// Collects the different literals of trees, in order of first use.
class LiteralSet {
 public:
  /// For every literal of the tree, its index in `literals()`. Cost: O(literals x different ones).
  std::vector<int> add(const Tree& tree);
  const std::vector<Literal>& literals() const { return literals_; }

 private:
  std::vector<Literal> literals_;
};

/// The box of all literals together, whatever the tree makes of them.
Box3 bounds_of_literals(const Tree& tree);

/// The diagonal of the tree's box; of its literals' boxes together where the tree is unbounded.
double scale_of(const Tree& tree);

}  // namespace hewn
