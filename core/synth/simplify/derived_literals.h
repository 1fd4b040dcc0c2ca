#pragma once
/// Primitives that stand for an intersection or difference of others: two aligned boxes meet in a
/// box, a box that covers the end of a cylinder shortens it.
#include <vector>

#include "core/csg/literal.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

/// One primitive equal to an intersection of sides of given literals.
struct DerivedLiteral {
  struct Side {
    int literal = -1;
    bool is_negated = false;
    bool operator==(const Side&) const = default;
  };
  Literal solid;
  std::vector<Side> sides;  ///< ascending by literal
};

/// At most `most` of them, those first that lie inside or outside of the wanted solid and fill many
/// of its cells. None equals a literal or another one on every cell.
/// Their surfaces are parts of the literals' surfaces, so they divide no cell.
/// Cost: O(rounds x literals x results x words).
std::vector<DerivedLiteral> derive_literals(const std::vector<Literal>& literals,
                                            const CellColumns& cells, const Column& wanted,
                                            std::size_t most);

/// The column of a derived literal: of the intersection of its sides.
Column column_of(const DerivedLiteral& derived, const CellColumns& cells);

}  // namespace hewn
