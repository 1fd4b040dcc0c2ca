#pragma once
/// The search for a smaller formula on known cells, by the method that was chosen.
#include "core/synth/optimise.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

struct FormulaAims {
  double least_proximity = 0;  ///< comes before size; 0: size alone counts
  int least_literals = 0;      ///< of any tree of the solid; 0: unknown
};

struct FoundFormula {
  Formula formula;
  int remaining_literals = 0;  ///< after decomposition, before they are rebuilt
  std::string qubo;            ///< of the remaining solid's set cover, if it is wanted
};

/// A formula equal to `start` on the cells of `care`, by `options.method`.
/// Fails with: TooLarge (Quine-McCluskey), Cancelled.
Result<FoundFormula> search_formula(Formula start, const CellColumns& cells, const Column& care,
                                    const OptimiseOptions& options, const FormulaAims& aims,
                                    const RunContext& run);

}  // namespace hewn
