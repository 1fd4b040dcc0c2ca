#pragma once
/// Removal of what a tree does not need (Friedrich et al. 2020, section 5.1).
#include "core/base/run_context.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

/// How often each rule applied.
struct RedundancyCounts {
  int empty = 0;      ///< operands that add nothing: empty, disjoint or swallowed
  int universal = 0;  ///< operands that hold everything they are asked about
  int decided = 0;    ///< operations whose value one operand decides
  int replaced = 0;   ///< subtrees equal to a single literal where it matters
  int passes = 0;
};

/// Drops operands, decided operations and subtrees that a literal can stand for, until no rule
/// applies. Each is judged on the cells where its value reaches the root: of an operand of an
/// intersection, those inside all the others. This covers the paper's rules (empty and universal
/// sets, identical operands, double complements), containment, and disjoint or swallowed operands
/// of differences.
///
/// The result equals the input on every cell of `care`; it never has more literals.
/// Cost: O(passes x literals^2 x words). Stops early, with a valid result, when cancelled.
Formula without_redundancy(Formula formula, const CellColumns& cells, const Column& care,
                           const RunContext& run, RedundancyCounts* counts = nullptr);

}  // namespace hewn
