#pragma once
/// Binary trees as postfix token strings: the creatures of the genetic algorithm.
#include <vector>

#include "core/base/rng.h"
#include "core/compute/tree_batch.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

/// A tree in postfix order; its number of tokens is its number of nodes `#|T|`.
using Genome = std::vector<Token>;

/// The operation that a token below 0 stands for, and back.
Op op_of(Token operation);
Token token_of(Op op);

/// A random tree of at most `most_nodes` nodes over literals 0 .. `literals` - 1.
Genome random_genome(int literals, int most_nodes, Rng& rng);

/// The formula as a binary tree; operands as in `to_tree`. Requires: no constants.
Genome genome_of(const Formula& formula);

/// Normalised.
Formula formula_of(const Genome& genome);

}  // namespace hewn
