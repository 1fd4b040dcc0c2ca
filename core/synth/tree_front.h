#pragma once
/// The Pareto front of a solid's trees: geometry, size and proximity.
#include <vector>

#include "core/synth/optimise.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

/// Where the search for a front begins.
struct FrontStart {
  const Tree& tree;                ///< the solid
  std::vector<Formula> formulas;   ///< of it, not constant; the first one tells its cells
  std::vector<Literal> literals;   ///< of the formulas
  const CellColumns& cells;        ///< of the literals
  EquivalenceOptions equivalence;  ///< what claims to be the same solid has to stand this test
};

/// The trees that no other one seen beats in all three, by genetic search.
/// Fails with: InvalidArgument, Cancelled.
Result<std::vector<FrontMember>> find_front(const FrontStart& start, const GeneticOptions& options,
                                            const RunContext& run);

}  // namespace hewn
