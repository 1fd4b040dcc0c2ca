#pragma once
/// CSG trees as values, and the measures `size` and `proximity`.
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/csg/literal.h"

namespace hewn {

enum class Op { Literal, Union, Intersection, Difference, Complement };

/// A node with any number of children, read as a left fold of the binary operation:
/// `a - b - c` is `((a - b) - c)`.
struct Node {
  Op op = Op::Literal;
  int literal = -1;           ///< index into `Tree::literals`; leaves only
  std::vector<int> children;  ///< indices into `Tree::nodes`; a node has one parent
  std::string name;           ///< of the partition that it stands for; empty for most
};

/// A tree; empty (the empty solid) when `root < 0`.
struct Tree {
  std::vector<Literal> literals;
  std::vector<Node> nodes;
  int root = -1;

  bool is_empty() const { return root < 0; }
  /// Adds the literal and its leaf; returns the leaf's index in `nodes`. Does not set `root`.
  int add_literal(Literal literal);
  /// Returns the node's index in `nodes`. Does not set `root`.
  int add_node(Op op, std::vector<int> children, std::string name = {});
  /// Copies `other` below this tree's node list; returns the index of its root, -1 when empty.
  /// Does not set `root`.
  int graft(const Tree& other);

  /// Signed distance by min/max over the literals' distances; negative inside. Never more than the
  /// true distance in absolute value. An operation without children is the empty solid.
  double signed_distance(const Vec3& x) const;
  bool contains(const Vec3& x) const { return signed_distance(x) < 0; }
  /// A box around the solid (not always the tightest).
  Box3 bounds() const;
};

/// Literals below the root.
int literal_count(const Tree& tree);

/// Nodes `#|T|` = literals + binary operations; a complement is a node.
int tree_size(const Tree& tree);

/// Proximity `P(T) / #|T|` (Friedrich et al. 2020, section on proximity): P(leaf) = 1,
/// P(a op b) = P(a) + P(b) + [a and b overlap]. An n-ary node counts as its left fold. Two nodes
/// overlap when one of `points` lies in both. A complement adds 1, so that 1 stays the best value;
/// an empty tree has proximity 1.
/// Cost: O(points x literals) distances and O(points x nodes) bits.
double proximity(const Tree& tree, const std::vector<Vec3>& points);

/// Merges nested unions, intersections and left-nested differences, `a - (b + c)` into `a - b - c`,
/// drops one-child operations, double complements, empty operands and unused literals. Named nodes
/// keep their identity. The solid and the number of literals in use stay; the size never grows.
Tree flattened(const Tree& tree);

/// The same solid without complement nodes, flattened: `a * !b` becomes `a - b` and so on. Names of
/// nodes that had to be turned inside out are lost. When the solid itself is unbounded it is cut to
/// a box three times as large as the literals' common bounds.
Tree without_complements(const Tree& tree);

}  // namespace hewn
