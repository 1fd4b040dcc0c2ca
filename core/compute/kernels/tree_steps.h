#pragma once
/// From trees in postfix order to the steps that kernels take.
#include "core/compute/kernels/token.h"
#include "core/compute/kernels/tree_kernel.h"

namespace hewn {

/// What is known of a tree's node; a token is the last one of its node.
struct TreeNode {
  std::int32_t begin = 0;   ///< the node's first token
  std::int32_t arrays = 0;  ///< work arrays that it needs; 0: a column
};

/// An operation whose step is still to be written.
struct PendingNode {
  std::int32_t node = 0;
  std::int16_t array = 0;    ///< the first work array that is free for it
  std::int16_t is_kept = 0;  ///< whether a later step than the next reads its result
};

/// How many steps a tree takes.
HEWN_HD std::int32_t step_count(const Token* tree, std::int32_t size) {
  std::int32_t operations = 0;
  for (std::int32_t i = 0; i < size; ++i) operations += tree[i] < 0 ? 1 : 0;
  return operations;
}

HEWN_HD TreeOp op_of_step(Token token, bool is_reversed) {
  switch (token) {
    case kUnionToken:
      return TreeOp::Union;
    case kIntersectionToken:
      return TreeOp::Intersection;
    case kDifferenceToken:
      return is_reversed ? TreeOp::ReverseDifference : TreeOp::Difference;
    default:
      return TreeOp::Complement;
  }
}

/// Looks at all nodes, operands first.
HEWN_HD void describe_nodes(const Token* tree, std::int32_t size, TreeNode* nodes) {
  for (std::int32_t i = 0; i < size; ++i) {
    nodes[i] = {i, 0};
    if (tree[i] >= 0) continue;
    const TreeNode right = nodes[i - 1];
    std::int32_t arrays = right.arrays;
    nodes[i].begin = right.begin;
    if (tree[i] != kComplementToken) {
      const TreeNode left = nodes[right.begin - 1];
      nodes[i].begin = left.begin;
      arrays = left.arrays > right.arrays   ? left.arrays
               : left.arrays < right.arrays ? right.arrays
               : left.arrays > 0            ? left.arrays + 1
                                            : 0;
    }
    nodes[i].arrays = arrays > 0 ? arrays : 1;
  }
}

/// Writes the steps of a tree, `step_count` of them, and returns where its value is after the last.
/// The needier operand comes first; its result then occupies one array (Sethi, Ullman 1970).
/// Requires: a complete formula of at most 2^15 leaves; scratch memory for `size` nodes and
/// `size` + 1 pending ones. Cost: O(size).
HEWN_HD TreeOperand write_steps(const Token* tree, std::int32_t size, TreeNode* nodes,
                                PendingNode* pending, TreeStep* steps) {
  const auto array_operand = [](int array) { return static_cast<TreeOperand>(-1 - array); };
  if (tree[size - 1] >= 0) return tree[size - 1];
  describe_nodes(tree, size, nodes);
  // Backwards, from the root: a node's step follows those of its second operand, and these those of
  // its first one.
  std::int32_t end = step_count(tree, size);
  std::int32_t open = 0;
  pending[open++] = {size - 1, 0, 0};
  while (open > 0) {
    const PendingNode own = pending[--open];
    const Token token = tree[own.node];
    TreeStep& step = steps[--end];
    step = {};
    step.target = static_cast<std::uint8_t>(own.array);
    step.is_kept = static_cast<std::uint8_t>(own.is_kept);
    const std::int32_t right = own.node - 1;
    if (token == kComplementToken) {
      step.op = TreeOp::Complement;
      step.a = tree[right] < 0 ? kPreviousResult : tree[right];
      step.b = array_operand(0);  // in the place of a second operand
      if (tree[right] < 0) pending[open++] = {right, own.array, 0};
      continue;
    }
    const std::int32_t left = nodes[right].begin - 1;
    const bool left_first = nodes[left].arrays >= nodes[right].arrays;
    const std::int32_t early = left_first ? left : right;
    const std::int32_t late = left_first ? right : left;
    const bool early_is_column = tree[early] >= 0;
    const bool late_is_column = tree[late] >= 0;
    // What was found last is at hand. Two columns stay in the tree's order.
    step.a = !late_is_column || !early_is_column ? kPreviousResult : tree[early];
    step.b = late_is_column ? tree[late] : early_is_column ? tree[early] : array_operand(own.array);
    step.is_swapped = !late_is_column == left_first ? 1 : 0;
    step.op = op_of_step(token, step.is_swapped != 0);
    if (!early_is_column) {
      pending[open++] = {early, own.array, static_cast<std::int16_t>(late_is_column ? 0 : 1)};
    }
    if (!late_is_column) {
      pending[open++] = {late, static_cast<std::int16_t>(own.array + (early_is_column ? 0 : 1)), 0};
    }
  }
  return kPreviousResult;
}

}  // namespace hewn
