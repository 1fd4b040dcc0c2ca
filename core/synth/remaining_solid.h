#pragma once
/// The methods that rebuild what decomposition leaves over, behind one call.
#include <string>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/synth/evolve/genetic.h"
#include "core/synth/simplify/formula.h"
#include "core/synth/simplify/rewrite_search.h"
#include "core/synth/twolevel/two_level.h"

namespace hewn {

enum class RemainingMethod {
  None,     ///< left as it is
  Rewrite,  ///< large neighbourhood search
  QuineMcCluskey,
  Espresso,
  SetCover,   ///< prime implicants and exact search
  Annealing,  ///< the same cover as a QUBO, annealed
  Genetic,
};

struct RemainingOptions {
  RewriteOptions rewrite = {};
  TwoLevelOptions two_level = {};
  GeneticOptions genetic = {};
};

/// A formula equal to `rest` on the cells of `care`. Two-level methods give a union of
/// intersections, which may be larger than `rest`.
/// Fails with: TooLarge (Quine-McCluskey), Cancelled.
Result<Formula> rebuild_remaining(RemainingMethod method, Formula rest, const CellColumns& cells,
                                  const Column& care, const RemainingOptions& options,
                                  const RunContext& run);

}  // namespace hewn
