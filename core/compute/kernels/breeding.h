#pragma once
/// How trees are chosen and changed: the operators of Fayolle and Pasko 2016, on postfix strings.
#include <cstddef>

#include "core/base/rng.h"
#include "core/compute/kernels/token.h"

namespace hewn {

struct BreedingRules {
  std::int32_t leaves = 1;       ///< leaves are numbered from 0 to this, exclusive
  std::int32_t most_tokens = 1;  ///< children that would be longer stay as they are
  double mutation = 0;           ///< share of the children that are changed at random
  double crossover = 0;          ///< share of the children with two parents
  std::int32_t tournament = 1;   ///< trees of which the best becomes a parent, > 0
};

/// A tree, and memory for more.
struct TokenRow {
  Token* tokens = nullptr;
  std::int32_t size = 0;
};

/// Where the subtree ends with the token at `last` begins. Cost: O(its size).
HEWN_HD std::int32_t subtree_begin(const Token* tokens, std::int32_t last) {
  std::int32_t open = 1;
  for (std::int32_t at = last;; --at) {
    const Token t = tokens[at];
    if (t >= 0) --open;
    if (t < 0 && t != kComplementToken) ++open;
    if (open == 0) return at;
  }
}

/// An operation for two operands.
HEWN_HD Token random_operation(Rng& rng) {
  return static_cast<Token>(kUnionToken - static_cast<Token>(rng.below(3)));
}

HEWN_HD Token random_leaf(std::int32_t leaves, Rng& rng) {
  return static_cast<Token>(rng.below(static_cast<std::size_t>(leaves)));
}

/// Writes a random tree of at most `most` tokens and returns how many. Requires: room for them, and
/// for `most` + 1 numbers in `pending`.
HEWN_HD std::int32_t write_random_tree(std::int32_t leaves, std::int32_t most, Rng& rng,
                                       Token* tokens, std::int32_t* pending) {
  constexpr std::int32_t kOperation = 0;  // all that is pending else are sizes of subtrees
  std::int32_t size = 0;
  std::int32_t open = 0;
  pending[open++] = 1 + static_cast<std::int32_t>(rng.below(static_cast<std::size_t>(most)));
  while (open > 0) {
    const std::int32_t wanted = pending[--open];
    if (wanted == kOperation) {
      tokens[size++] = random_operation(rng);
    } else if (wanted < 3) {
      tokens[size++] = random_leaf(leaves, rng);
    } else {
      const std::int32_t inner = wanted - 1;
      const auto left =
          1 + static_cast<std::int32_t>(rng.below(static_cast<std::size_t>(inner - 1)));
      pending[open++] = kOperation;
      pending[open++] = inner - left;
      pending[open++] = left;
    }
  }
  return size;
}

/// Puts `part` in the place of the subtree that ends at `last`, when there is room. The part may
/// lie within that subtree.
HEWN_HD void replace_subtree(TokenRow& row, std::int32_t last, const Token* part,
                             std::int32_t part_size, std::int32_t most) {
  const std::int32_t first = subtree_begin(row.tokens, last);
  const std::int32_t change = part_size - (last - first + 1);
  if (row.size + change > most) return;
  if (change > 0) {
    for (std::int32_t i = row.size; --i > last;) row.tokens[i + change] = row.tokens[i];
  }
  for (std::int32_t i = 0; i < part_size; ++i) row.tokens[first + i] = part[i];
  if (change < 0) {
    for (std::int32_t i = last + 1; i < row.size; ++i) row.tokens[i + change] = row.tokens[i];
  }
  row.size += change;
}

/// Puts a random subtree of the other parent in the place of one of the row's.
HEWN_HD void cross(TokenRow& row, const Token* other, std::int32_t other_size, std::int32_t most,
                   Rng& rng) {
  const auto last = static_cast<std::int32_t>(rng.below(static_cast<std::size_t>(other_size)));
  const std::int32_t first = subtree_begin(other, last);
  const auto place = static_cast<std::int32_t>(rng.below(static_cast<std::size_t>(row.size)));
  replace_subtree(row, place, other + first, last - first + 1, most);
}

/// A new subtree, a subtree in the place of its parent, another leaf, or another operation.
HEWN_HD void mutate(TokenRow& row, const BreedingRules& rules, Rng& rng) {
  constexpr std::int32_t kNewTokens = 7;
  const auto place = static_cast<std::int32_t>(rng.below(static_cast<std::size_t>(row.size)));
  Token& token = row.tokens[place];
  switch (rng.below(4)) {
    case 0: {
      Token tokens[kNewTokens];
      std::int32_t pending[kNewTokens + 1];
      const std::int32_t size = write_random_tree(rules.leaves, kNewTokens, rng, tokens, pending);
      replace_subtree(row, place, tokens, size, rules.most_tokens);
      return;
    }
    case 1: {
      if (token >= 0) return;
      const std::int32_t first = subtree_begin(row.tokens, place - 1);
      replace_subtree(row, place, row.tokens + first, place - first, rules.most_tokens);
      return;
    }
    case 2:
      if (token >= 0) token = random_leaf(rules.leaves, rng);
      return;
    default:
      if (token < 0 && token != kComplementToken) token = random_operation(rng);
  }
}

/// The best of some trees drawn at random. `Parents` has `size()` and `is_better(a, b)`.
template <class Parents>
HEWN_HD std::int32_t winner(const Parents& parents, std::int32_t rounds, Rng& rng) {
  const auto draw = [&] { return static_cast<std::int32_t>(rng.below(parents.size())); };
  std::int32_t best = draw();
  for (std::int32_t i = 1; i < rounds; ++i) {
    const std::int32_t other = draw();
    if (parents.is_better(other, best)) best = other;
  }
  return best;
}

/// Makes `child` one of the parents, perhaps crossed with another one, perhaps changed.
/// `Parents` has also `tokens(i)` and `token_count(i)`. Requires: room in `child` for any parent
/// and for `most_tokens`.
template <class Parents>
HEWN_HD void breed(const BreedingRules& rules, const Parents& parents, Rng& rng, TokenRow& child) {
  const std::int32_t first = winner(parents, rules.tournament, rng);
  child.size = parents.token_count(first);
  for (std::int32_t i = 0; i < child.size; ++i) child.tokens[i] = parents.tokens(first)[i];
  if (rng.uniform() < rules.crossover) {
    const std::int32_t other = winner(parents, rules.tournament, rng);
    cross(child, parents.tokens(other), parents.token_count(other), rules.most_tokens, rng);
  }
  if (rng.uniform() < rules.mutation) mutate(child, rules, rng);
}

}  // namespace hewn
