#pragma once
/// The genetic algorithm turned round: trees grow redundant parts (Friedrich et al. 2020, section
/// 6.1, GA-based redundancy insertion).
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"
#include "core/synth/evolve/genome.h"

namespace hewn {

/// Grows trees over one tree's literals.
class RedundancyGrowth {
 public:
  /// Fails with: Cancelled. Cost: that of the literals' arrangement.
  static Result<RedundancyGrowth> of(const Tree& tree, const RunContext& run);

  /// A tree of the same solid with a few more nodes, at most `most_nodes`, or `genome` when none
  /// was found and proved. Tokens are indices of the tree's literals.
  /// Fails with: Cancelled. Deterministic for `run.seed`.
  Result<Genome> grow(const Genome& genome, int most_nodes, const RunContext& run) const;

 private:
  RedundancyGrowth(std::vector<Literal> literals, std::vector<int> column_of, CellColumns cells);
  Tree tree_of(const Genome& genome) const;

  std::vector<Literal> literals_;  ///< different ones, by column
  std::vector<int> column_of_;     ///< by literal of the tree
  std::vector<int> literal_of_;    ///< by column: the tree's first such literal
  CellColumns cells_;
};

}  // namespace hewn
