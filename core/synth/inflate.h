#pragma once
/// Trees with artificial redundancy (Friedrich et al. 2020, section 6.1), to test optimisers.
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"

namespace hewn {

/// In every iteration each strategy is applied with its probability at a random place.
struct InflateOptions {
  int iterations = 10;
  double copied_subtree = 1;   ///< A to A + A or A * A
  double double_negation = 1;  ///< A to !!A
  double distributive = 1;     ///< A (B + C) to A B + A C, or its dual
  double absorption = 1;       ///< A to A + A B or A (A + B), with B from elsewhere in the tree
  double genetic = 1;          ///< redundant parts found by the genetic algorithm
  int most_nodes = 1000;       ///< an application that would exceed it is left out
};

/// A larger tree of the same solid, binary; what the genetic algorithm adds is compared as
/// optimised trees are. Deterministic for `run.seed`.
/// Fails with: InvalidArgument (a probability outside [0, 1]), Cancelled.
Result<Tree> inflate(const Tree& tree, const InflateOptions& options, const RunContext& run);

}  // namespace hewn
