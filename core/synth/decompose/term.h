#pragma once
/// Terms and decision lists: the form in which a solid is searched for.
#include <memory>
#include <vector>

#include "core/compute/bits.h"
#include "core/fit/halfspace_side.h"

namespace hewn {

using TermLiteral = HalfspaceSide;

/// An intersection of halfspace sides: a box, a capped cylinder, a box less a cylinder, ...
struct Term {
  std::vector<TermLiteral> literals;
  bool fills = true;        ///< united with the solid, else subtracted from it
  int cost = 0;             ///< bounded primitives needed to write it down
  std::vector<Word> cover;  ///< the cells in the intersection
  /// Planes within which a cutting term does all its work: it may end anywhere beyond them.
  std::vector<TermLiteral> work_ends;
};

using TermPtr = std::shared_ptr<const Term>;

/// The first item that covers a cell decides it; `base` decides what none covers. Read backwards it
/// is a chain of unions and differences. With a recursive decomposition (Friedrich et al. 2020,
/// dominant halfspaces) the list is peeled from the outside in.
struct DecisionList {
  std::vector<TermPtr> items;
  bool base = false;

  int cost() const {
    int total = base ? 1 : 0;
    for (const TermPtr& t : items) total += t->cost;
    return total;
  }
};

}  // namespace hewn
