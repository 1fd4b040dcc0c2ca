#pragma once
/// The published search: trees over bounded primitives evolve until they fit the surface (Fayolle
/// and Pasko 2016; Stroeter et al. 2026, "CSG Reconstruction"). Kept to compare with: `find_tree`
/// finds smaller and more exact trees in less time.
#include "core/synth/find_tree.h"

namespace hewn {

struct EvolveOptions {
  int samples = 2000;  ///< points of the surface
  int population = 150;
  double mutation = 0.3;
  double crossover = 0.3;
  int tournament = 2;
  int elite = 15;             ///< creatures that pass on unchanged
  int iterations = 1000;      ///< generations at most
  int most_idle = 200;        ///< generations without a better tree
  double enough = 0.999;      ///< score of a surface that fits, at which the search ends
  double distance = 0.01;     ///< share of the diagonal at which a point's score falls to 1 / e
  double angle_deg = 10;      ///< the same for its normal
  double size_penalty = 0.3;  ///< of a node, in units of log(samples) / (2 samples)
};

template <>
std::span<const OptionField<EvolveOptions>> option_table<EvolveOptions>();

/// Finds a tree for the problem. The bounded primitives are those with a face group of the
/// partition; one or two of them are combined in every way instead of evolved.
/// Fails with: NotFound (no bounded primitive), Cancelled.
/// Deterministic for `run.seed`, for any number of threads.
Result<TreeAnswer> evolve_tree(const TreeProblem& problem, const EvolveOptions& options,
                               const RunContext& run);

}  // namespace hewn
