#pragma once
/// Binary trees as postfix token strings: the creatures of the genetic algorithm.
#include <cstdint>
#include <vector>

#include "core/base/rng.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

/// A literal's index, or one of the operations below.
using Token = std::int16_t;
inline constexpr Token kUnionToken = -1;
inline constexpr Token kIntersectionToken = -2;
inline constexpr Token kDifferenceToken = -3;
inline constexpr Token kComplementToken = -4;

/// A tree in postfix order; its number of tokens is its number of nodes `#|T|`.
using Genome = std::vector<Token>;

/// Where the subtree ends with the token at `last` begins. Cost: O(its size).
std::size_t subtree_begin(const Genome& genome, std::size_t last);

/// A random tree of at most `most_nodes` nodes over literals 0 .. `literals` - 1.
Genome random_genome(int literals, int most_nodes, Rng& rng);

/// The formula as a binary tree; operands as in `to_tree`. Requires: no constants.
Genome genome_of(const Formula& formula);

/// Normalised.
Formula formula_of(const Genome& genome);

}  // namespace hewn
