#include <algorithm>
#include <cstdint>

#include "core/csg/tree.h"

namespace hewn {
namespace {

int count_literals(const Tree& tree, int index) {
  const Node& node = tree.nodes[index];
  if (node.op == Op::Literal) return 1;
  int n = 0;
  for (const int child : node.children) n += count_literals(tree, child);
  return n;
}

int count_operations(const Tree& tree, int index) {
  const Node& node = tree.nodes[index];
  if (node.op == Op::Literal) return 0;
  int n = node.op == Op::Complement ? 1 : std::max(0, static_cast<int>(node.children.size()) - 1);
  for (const int child : node.children) n += count_operations(tree, child);
  return n;
}

/// One bit per point, packed.
using Column = std::vector<std::uint64_t>;

Column literal_column(const Literal& literal, const std::vector<Vec3>& points) {
  Column column((points.size() + 63) / 64, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (literal.signed_distance(points[i]) < 0) column[i / 64] |= std::uint64_t{1} << (i % 64);
  }
  return column;
}

bool overlap(const Column& a, const Column& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if ((a[i] & b[i]) != 0) return true;
  }
  return false;
}

struct Measured {
  Column column;
  int proximity = 0;
};

void combine(Op op, Measured& left, const Measured& right) {
  left.proximity += right.proximity + (overlap(left.column, right.column) ? 1 : 0);
  for (std::size_t i = 0; i < left.column.size(); ++i) {
    if (op == Op::Union) left.column[i] |= right.column[i];
    if (op == Op::Intersection) left.column[i] &= right.column[i];
    if (op == Op::Difference) left.column[i] &= ~right.column[i];
  }
}

Measured measure(const Tree& tree, int index, const std::vector<Vec3>& points) {
  const Node& node = tree.nodes[index];
  if (node.op == Op::Literal) return {literal_column(tree.literals[node.literal], points), 1};
  if (node.children.empty()) return {Column((points.size() + 63) / 64, 0), 0};
  Measured result = measure(tree, node.children[0], points);
  if (node.op == Op::Complement) {
    for (std::uint64_t& word : result.column) word = ~word;
    // The bits past the last point must stay clear, or every two complements would overlap.
    if (points.size() % 64 != 0) {
      result.column.back() &= (std::uint64_t{1} << (points.size() % 64)) - 1;
    }
    ++result.proximity;
    return result;
  }
  for (std::size_t i = 1; i < node.children.size(); ++i) {
    combine(node.op, result, measure(tree, node.children[i], points));
  }
  return result;
}

}  // namespace

int literal_count(const Tree& tree) {
  return tree.is_empty() ? 0 : count_literals(tree, tree.root);
}

int tree_size(const Tree& tree) {
  return tree.is_empty() ? 0 : literal_count(tree) + count_operations(tree, tree.root);
}

double proximity(const Tree& tree, const std::vector<Vec3>& points) {
  const int size = tree_size(tree);
  if (size == 0) return 1;
  return static_cast<double>(measure(tree, tree.root, points).proximity) / size;
}

}  // namespace hewn
