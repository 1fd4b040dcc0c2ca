#pragma once
/// A Boolean tree without its nodes: which literal to look at next, until the answer is known.
#include <cstdint>
#include <vector>

#include "core/csg/tree.h"

namespace hewn {

/// Looks at one literal, and goes on to `inside` or `outside`: an index of a step, or one of the
/// two answers.
struct BranchStep {
  std::uint32_t literal = 0, inside = 0, outside = 0, unused = 0;
  bool operator==(const BranchStep&) const = default;
};

/// No literal is looked at that cannot change the answer any more.
struct BranchingProgram {
  static constexpr std::uint32_t kSolid = 0xFFFFFFFEU;  ///< the point is inside the tree
  static constexpr std::uint32_t kEmpty = 0xFFFFFFFFU;  ///< it is not

  std::vector<BranchStep> steps;  ///< each goes only to later ones; one per leaf
  std::uint32_t start = kEmpty;   ///< first step, or an answer

  /// The answer for a point that `holds(literal)` for the literals that hold it.
  template <class Holds>
  bool run(const Holds& holds) const {
    std::uint32_t at = start;
    while (at < kSolid) at = holds(steps[at].literal) ? steps[at].inside : steps[at].outside;
    return at == kSolid;
  }
};

/// The program of a tree. Cost: O(nodes).
BranchingProgram branching_program(const Tree& tree);

}  // namespace hewn
