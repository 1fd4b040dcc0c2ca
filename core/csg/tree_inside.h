#pragma once
/// Membership in a tree's solid without distances.
#include <vector>

#include "core/csg/branching_program.h"
#include "core/csg/literal_bounds.h"
#include "core/csg/tree.h"

namespace hewn {

/// The same answers as `Tree::contains` but on surfaces, at a fraction of the cost: operands that
/// cannot change the answer are not looked at. Thread-safe; the tree must outlive it.
class TreeInside {
 public:
  explicit TreeInside(const Tree& tree);

  bool contains(const Vec3& x) const;

 private:
  const Tree* tree_;
  BranchingProgram program_;
  std::vector<LiteralBounds> bounds_;  ///< of each literal
};

}  // namespace hewn
