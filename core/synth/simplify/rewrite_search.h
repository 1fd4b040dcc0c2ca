#pragma once
/// Large neighbourhood search over trees: cut out a part, build it anew for the cells where it
/// matters, keep it when it is no larger.
#include "core/base/run_context.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

struct RewriteOptions {
  int steps_per_literal = 120;  ///< windows tried, for each literal of the formula
  int most_steps = 30'000;
  int largest_window = 14;  ///< literals of a part that is cut out
  int attempts = 2;         ///< formulas tried for each window
  /// Work after which the search ends, in words of columns (about 3e9 a second).
  double most_work = 2e9;
  /// Formulas with at least this proximity are better than those without, whatever their size.
  double least_proximity = 0;
  /// No formula of the solid has fewer literals. One that has no more, all of them near together,
  /// ends the search; the nearer it is the fewer steps are taken.
  int least_literals = 0;
};

/// A formula with at most as many literals that agrees with the input on every cell of `care`.
/// Windows are subtrees or some operands of an operation; equal exchanges are kept, too, so that
/// commuted, distributed, factored and absorbed forms are reached.
/// Deterministic for `run.seed`. Stops early, with a valid result, when cancelled.
Formula rewrite_search(Formula formula, const CellColumns& cells, const Column& care,
                       const RewriteOptions& options, const RunContext& run);

}  // namespace hewn
