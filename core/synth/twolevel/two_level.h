#pragma once
/// Two-level minimisation: Quine-McCluskey, Espresso and set covers over prime implicants
/// (Friedrich et al. 2020, section 5.3.1).
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/synth/twolevel/cube_cover.h"

namespace hewn {

struct TwoLevelOptions {
  int most_variables = 13;              ///< of Quine-McCluskey: its tables have 3^n entries
  std::int64_t most_branches = 20'000;  ///< of the exact cover search
  int expansions_per_row = 3;           ///< prime implicants tried for each row, of the set cover
  AnnealOptions anneal = {};
};

/// All prime implicants, from the bottom up, and the cheapest cover of them (Quine 1952,
/// McCluskey 1956). Fails with: TooLarge (more variables than `most_variables`), Cancelled.
Result<std::vector<Cube>> quine_mccluskey(const TwoLevelProblem& problem,
                                          const TwoLevelOptions& options, const RunContext& run);

/// Expand, irredundant, reduce, until the cover does not shrink (Brayton et al. 1984), with
/// combinations that no cell has as don't-cares. Fails with: Cancelled.
Result<std::vector<Cube>> espresso(const TwoLevelProblem& problem, const RunContext& run);

/// Prime implicants by dropping literals from each canonical term, in the order of the literals and
/// in random ones. Duplicates are left out.
std::vector<Cube> prime_implicants(const TwoLevelProblem& problem, const TwoLevelOptions& options,
                                   const RunContext& run);

/// The cheapest cover by prime implicants: by exact search, or by annealing its QUBO.
/// Fails with: Cancelled.
Result<std::vector<Cube>> set_cover(const TwoLevelProblem& problem, bool by_annealing,
                                    const TwoLevelOptions& options, const RunContext& run);

}  // namespace hewn
