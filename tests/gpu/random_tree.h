#pragma once
/// Random trees for tests of what evaluates many of them.
#include <vector>

#include "core/base/rng.h"
#include "core/compute/tree_batch.h"

namespace hewn::testing {

/// Appends a tree of that many leaves, with complements here and there.
inline void append_random_tree(std::vector<Token>& out, std::size_t leaves, std::size_t columns,
                               Rng& rng) {
  if (leaves == 1) {
    out.push_back(static_cast<Token>(rng.below(columns)));
  } else {
    const std::size_t left = 1 + rng.below(leaves - 1);
    append_random_tree(out, left, columns, rng);
    append_random_tree(out, leaves - left, columns, rng);
    out.push_back(static_cast<Token>(kUnionToken - static_cast<Token>(rng.below(3))));
  }
  if (rng.below(5) == 0) out.push_back(kComplementToken);
}

}  // namespace hewn::testing
