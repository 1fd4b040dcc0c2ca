#pragma once
/// The cheapest sets that cover all elements: exact search with a greedy bound, and the same
/// problem as a QUBO (Lucas 2014, section 5.1) for annealers.
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/run_context.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

/// Element i is bit i of the columns.
struct SetCoverProblem {
  std::size_t elements = 0;
  std::vector<Column> sets;
  std::vector<int> costs;  ///< positive, one per set
};

struct SetCover {
  std::vector<int> chosen;  ///< ascending
  int cost = 0;
  bool is_complete = false;  ///< every element is covered
  bool is_optimal = false;   ///< proved to be the cheapest
};

/// The set with the most new elements for its cost, again and again; then drops what is not needed.
SetCover greedy_cover(const SetCoverProblem& problem);

/// Branch and bound: essential sets, dominated sets, and a bound by elements that no set has in
/// common. Ends after `most_nodes` branches, or when stopped, with the best cover so far.
SetCover exact_cover(const SetCoverProblem& problem, std::int64_t most_nodes,
                     const RunContext& run);

/// Minimise x^T Q x + offset over bits x: the first `sets` bits choose sets, the others count how
/// often an element is covered.
struct Qubo {
  struct Entry {
    int row = 0, column = 0;  ///< row <= column
    double value = 0;
  };
  int variables = 0;
  int sets = 0;
  std::vector<Entry> entries;  ///< by row, then column; each pair once
  double offset = 0;
  double penalty = 0;  ///< A: of a broken constraint; the costs are B = 1 each
};

/// The penalty is more than the cost of any set, so that the least energy is the cheapest cover's
/// cost.
Qubo qubo_of(const SetCoverProblem& problem);

double energy(const Qubo& qubo, const std::vector<char>& bits);

/// {"hewn-qubo": 1, "variables": n, "offset": c, "entries": [[row, column, value], ...]}.
std::string qubo_to_json(const Qubo& qubo);

struct AnnealOptions {
  int sweeps = 2000;
  int restarts = 4;
};

/// Simulated annealing on the QUBO; elements that stay uncovered are then covered greedily and sets
/// that are not needed dropped. Deterministic for `run.seed`.
SetCover anneal_cover(const SetCoverProblem& problem, const AnnealOptions& options,
                      const RunContext& run);

}  // namespace hewn
