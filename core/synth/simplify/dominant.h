#pragma once
/// Recursive decomposition by dominant halfspaces (Friedrich et al. 2020, section 5.2).
#include <vector>

#include "core/base/run_context.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

/// S = (((rest op d1) op d2) ...): literals that lie in the solid are united, those outside of it
/// subtracted, those around it intersected.
struct DominantStep {
  int literal = -1;
  bool is_negated = false;
  bool is_union = false;  ///< else intersected; `is_negated` makes that a difference
};

struct Decomposition {
  std::vector<DominantStep> steps;  ///< the first one found stands outermost
  Formula rest;
  Column care;  ///< cells that the steps leave open
};

/// Peels dominant literals of the formula off the solid and its complement; cells that they decide
/// become don't-cares for the rest, which is freed of redundancy after every peel. The largest
/// dominating set of cells goes first. When the rest is a constant or a literal, the chain is a
/// size-optimal tree.
Decomposition decompose(Formula formula, const CellColumns& cells, const Column& care,
                        const RunContext& run);

/// The chain with `rest` in its middle. Normalised.
Formula recomposed(const Decomposition& decomposition, Formula rest);

}  // namespace hewn
