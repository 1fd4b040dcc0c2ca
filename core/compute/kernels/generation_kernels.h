#pragma once
/// Generations of trees that breed on a device.
#include "core/compute/kernels/breeding.h"
#include "core/compute/kernels/tree_steps.h"

namespace hewn {

/// Trees in rows of `kMostTokens`, with the total scores of their surfaces.
struct TreeRows {
  static constexpr std::int32_t kMostTokens = 256;
  Token* tokens = nullptr;
  std::int32_t* sizes = nullptr;
  std::uint64_t* totals = nullptr;

  HEWN_HD TokenRow row(std::int64_t tree) const {
    return {tokens + tree * kMostTokens, sizes[tree]};
  }
};

/// What a tree is worth: its surface's share of the best score, less what its nodes cost.
struct TreeWorth {
  double best_total = 1;
  double node_cost = 0;

  HEWN_HD double fit(std::uint64_t total) const { return static_cast<double>(total) / best_total; }
  HEWN_HD double score(std::uint64_t total, std::int32_t size) const {
    return fit(total) - node_cost * static_cast<double>(size);
  }
};

/// Whether tree `a` is better than `b`; of equal ones the first is.
HEWN_HD bool is_better(double score_a, std::int32_t a, double score_b, std::int32_t b) {
  return score_a > score_b || (score_a == score_b && a < b);
}

/// The next generation: the elite as it is, then children. One item is one tree, with random
/// numbers of its own.
struct BreedKernel {
  TreeRows parents;
  TreeRows children;  ///< out; of the totals, those of the elite, the others 0
  std::int64_t tree_count = 0;
  const std::int32_t* elite = nullptr;  ///< the parents that pass on unchanged
  std::int64_t elite_count = 0;         ///< at most `tree_count`
  BreedingRules rules;                  ///< at most `TreeRows::kMostTokens` tokens
  TreeWorth worth;
  std::uint64_t seed = 0;

  template <class Grain>
  HEWN_HD std::int64_t items() const {
    return tree_count;
  }
  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    TokenRow child{children.tokens + item * TreeRows::kMostTokens, 0};
    if (item < elite_count) {
      const TokenRow parent = parents.row(elite[item]);
      child.size = parent.size;
      for (std::int32_t i = 0; i < child.size; ++i) child.tokens[i] = parent.tokens[i];
      children.totals[item] = parents.totals[elite[item]];
    } else {
      Rng rng(seed, static_cast<std::uint64_t>(item));
      breed(rules, Ranked{*this}, rng, child);
      children.totals[item] = 0;
    }
    children.sizes[item] = child.size;
  }

 private:
  /// The parents, as `breed` asks for them.
  struct Ranked {
    const BreedKernel& kernel;
    HEWN_HD std::size_t size() const { return static_cast<std::size_t>(kernel.tree_count); }
    HEWN_HD bool is_better(std::int32_t a, std::int32_t b) const {
      return hewn::is_better(score(a), a, score(b), b);
    }
    HEWN_HD const Token* tokens(std::int32_t i) const { return kernel.parents.row(i).tokens; }
    HEWN_HD std::int32_t token_count(std::int32_t i) const { return kernel.parents.sizes[i]; }
    HEWN_HD double score(std::int32_t i) const {
      return kernel.worth.score(kernel.parents.totals[i], kernel.parents.sizes[i]);
    }
  };
};

/// From rows of tokens to steps, which lie in rows of as many. One item is one tree.
struct TranslateKernel {
  TreeRows rows;
  std::int64_t tree_count = 0;
  TreeSpan* spans = nullptr;  ///< out
  TreeStep* steps = nullptr;  ///< out

  template <class Grain>
  HEWN_HD std::int64_t items() const {
    return tree_count;
  }
  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    TreeNode nodes[TreeRows::kMostTokens];
    PendingNode pending[TreeRows::kMostTokens + 1];
    const TokenRow row = rows.row(item);
    const auto first = static_cast<std::int32_t>(item * TreeRows::kMostTokens);
    spans[item].first_step = first;
    spans[item].steps = step_count(row.tokens, row.size);
    spans[item].value = write_steps(row.tokens, row.size, nodes, pending, steps + first);
  }
};

}  // namespace hewn
