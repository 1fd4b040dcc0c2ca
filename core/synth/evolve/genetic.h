#pragma once
/// The genetic algorithm of Friedrich et al. 2020, section 5.3.2, on bit columns.
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/synth/evolve/fitness.h"
#include "core/synth/evolve/pareto.h"

namespace hewn {

struct GeneticOptions {
  int population = 150;
  double mutation = 0.3;
  double crossover = 0.4;
  int tournament = 2;
  int elite = 2;  ///< creatures that pass on unchanged
  double geometry_weight = 50;
  double proximity_weight = 1;
  double size_weight = 10;
  int iterations = 1000;
  int most_idle = 500;  ///< iterations without a better score
  double largest = 2;   ///< creatures have at most so many times the input's nodes
};

struct GeneticResult {
  /// Of those with all rows right the smallest, or the largest with a negative weight of the size.
  Genome best;
  std::vector<ParetoMember> front;  ///< of all creatures that were seen
  long evaluations = 0;
  int iterations = 0;
};

/// Evolves trees from copies of `starts`, of which the first one is right, and random ones. A tree
/// is right where it holds the cells of `wanted`, among those of `care`.
/// Fails with: InvalidArgument, Cancelled. Deterministic for `run.seed`.
Result<GeneticResult> evolve(const std::vector<Genome>& starts, const CellColumns& cells,
                             const Column& wanted, const Column& care,
                             const GeneticOptions& options, const RunContext& run);

}  // namespace hewn
