#include "core/synth/remaining_solid.h"

#include <utility>

namespace hewn {
namespace {

Result<std::vector<Cube>> cubes_by(RemainingMethod method, const TwoLevelProblem& problem,
                                   const TwoLevelOptions& options, const RunContext& run) {
  if (method == RemainingMethod::QuineMcCluskey) return quine_mccluskey(problem, options, run);
  if (method == RemainingMethod::Espresso) return espresso(problem, run);
  return set_cover(problem, method == RemainingMethod::Annealing, options, run);
}

}  // namespace

Result<Formula> rebuild_remaining(RemainingMethod method, Formula rest, const CellColumns& cells,
                                  const Column& care, const RemainingOptions& options,
                                  const RunContext& run) {
  if (method == RemainingMethod::None || leaf_count(rest) < 2) return rest;
  if (method == RemainingMethod::Rewrite) {
    return rewrite_search(std::move(rest), cells, care, options.rewrite, run);
  }
  if (method == RemainingMethod::Genetic) {
    rest = normalised(std::move(rest));
    if (rest.is_constant()) return rest;
    const Column wanted = evaluate(rest, cells);
    const auto evolved = evolve({genome_of(rest)}, cells, wanted, care, options.genetic, run);
    if (!evolved) return evolved.error();
    return formula_of(evolved->best);
  }
  const TwoLevelProblem problem = two_level_problem(std::move(rest), cells, care);
  const auto cubes = cubes_by(method, problem, options.two_level, run);
  if (!cubes) return cubes.error();
  return formula_of(*cubes, problem);
}

}  // namespace hewn
