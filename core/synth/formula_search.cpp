#include "core/synth/formula_search.h"

#include <utility>

#include "core/synth/simplify/dominant.h"

namespace hewn {
namespace {

class FormulaSearch {
 public:
  FormulaSearch(const CellColumns& cells, const Column& care, const OptimiseOptions& options,
                const FormulaAims& aims, const RunContext& run)
      : cells_(cells), care_(care), options_(options), aims_(aims), run_(run) {}

  /// Large neighbourhood search over the whole tree.
  Result<FoundFormula> rewrite(Formula f) const {
    RewriteOptions rewrite = options_.remaining.rewrite;
    rewrite.steps_per_literal *= options_.effort;
    rewrite.most_steps *= options_.effort;
    rewrite.most_work *= options_.effort;
    rewrite.least_proximity = aims_.least_proximity;
    rewrite.least_literals = aims_.least_literals;
    Formula best = rewrite_search(f, cells_, care_, rewrite, run_);
    // From far off, as from an inflated tree, a disjunctive form can be the better start.
    constexpr std::size_t kMostCells = 2000;
    if (cells_.cells() > kMostCells || leaf_count(best) <= aims_.least_literals) {
      return FoundFormula{std::move(best), 0, {}};
    }
    const Decomposition d = decompose(std::move(f), cells_, care_, run_);
    auto rest = rebuild_remaining(RemainingMethod::Espresso, d.rest, cells_, d.care, {}, run_);
    if (!rest) return rest.error();
    Formula other = recomposed(d, std::move(*rest));
    if (leaf_count(other) > 2 * leaf_count(best)) return FoundFormula{std::move(best), 0, {}};
    other = rewrite_search(std::move(other), cells_, care_, rewrite, run_);
    const bool is_smaller = leaf_count(other) < leaf_count(best);
    return FoundFormula{std::move(is_smaller ? other : best), 0, {}};
  }

  /// The paper's way: decompose, rebuild what remains, put it back.
  Result<FoundFormula> rebuild_rest(Formula f) const {
    FoundFormula found;
    const Decomposition d = decompose(std::move(f), cells_, care_, run_);
    found.remaining_literals = leaf_count(d.rest);
    if (options_.wants_qubo) {
      const TwoLevelProblem problem = two_level_problem(d.rest, cells_, d.care);
      const auto primes = prime_implicants(problem, options_.remaining.two_level, run_);
      found.qubo = qubo_to_json(qubo_of(covering_problem(primes, problem)));
    }
    auto rebuilt = rebuild_remaining(remaining_method(options_.method), d.rest, cells_, d.care,
                                     options_.remaining, run_);
    if (!rebuilt) return rebuilt.error();
    // A disjunctive form may be longer than what was there.
    const bool is_longer = leaf_count(*rebuilt) > leaf_count(d.rest);
    found.formula = recomposed(d, is_longer ? d.rest : std::move(*rebuilt));
    return found;
  }

 private:
  const CellColumns& cells_;
  const Column& care_;
  const OptimiseOptions& options_;
  const FormulaAims& aims_;
  const RunContext& run_;
};

}  // namespace

Result<FoundFormula> search_formula(Formula start, const CellColumns& cells, const Column& care,
                                    const OptimiseOptions& options, const FormulaAims& aims,
                                    const RunContext& run) {
  const FormulaSearch search(cells, care, options, aims, run);
  return options.method == OptimiseMethod::Rewrite ? search.rewrite(std::move(start))
                                                   : search.rebuild_rest(std::move(start));
}

}  // namespace hewn
