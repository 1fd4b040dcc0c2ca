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
  int add_literal(Literal literal);
  int add_node(Op op, std::vector<int> children, std::string name = {});
  /// Copies `other` below this tree's node list; returns the index of its root, -1 when empty.
  int graft(const Tree& other);

  /// Signed distance by min/max over the literals' distances; negative inside.
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
/// overlap when one of `points` lies in both.
double proximity(const Tree& tree, const std::vector<Vec3>& points);

/// Merges nested unions, intersections and left-nested differences, drops one-child operations and
/// unused literals. Named nodes keep their identity.
Tree flattened(const Tree& tree);

}  // namespace hewn
