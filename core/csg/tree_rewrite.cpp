// Rewrites that keep the solid: flattening and the removal of complements.
#include <algorithm>
#include <utility>

#include "core/csg/literal_set.h"
#include "core/csg/tree.h"

namespace hewn {
namespace {

constexpr int kNothing = -1;  ///< stands for the empty solid while rewriting

/// Copies a tree bottom-up into a new one, merging on the way.
class Flattener {
 public:
  explicit Flattener(const Tree& source) : source_(source) {}

  Tree run() {
    Tree tree;
    std::swap(out_, tree);
    if (!source_.is_empty()) out_.root = visit(source_.root);
    return compacted(std::move(out_));
  }

 private:
  int visit(int index) {
    const Node& node = source_.nodes[index];
    if (node.op == Op::Literal) {
      const int leaf = out_.add_literal(source_.literals[node.literal]);
      out_.nodes[leaf].name = node.name;
      return leaf;
    }
    if (node.op == Op::Complement) return visit_complement(node);
    std::vector<int> children;
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      const int child = visit(node.children[i]);
      if (child == kNothing) {
        if (node.op == Op::Intersection || (node.op == Op::Difference && i == 0)) return kNothing;
        continue;
      }
      append(node.op, i == 0, child, children);
    }
    return finish(node, std::move(children));
  }

  int visit_complement(const Node& node) {
    const int child = node.children.empty() ? kNothing : visit(node.children[0]);
    // "Everything" has no simpler form than the complement of an empty union.
    if (child == kNothing) {
      return out_.add_node(Op::Complement, {out_.add_node(Op::Union, {})}, node.name);
    }
    Node& inner = out_.nodes[child];
    if (inner.op == Op::Complement && inner.name.empty() && node.name.empty()) {
      return inner.children[0];
    }
    return out_.add_node(Op::Complement, {child}, node.name);
  }

  /// Adds `child` to the operands of `op`, or its own operands when it merges.
  void append(Op op, bool is_first, int child, std::vector<int>& children) {
    const Node& node = out_.nodes[child];
    const bool is_nested =
        op == Op::Difference ? node.op == (is_first ? Op::Difference : Op::Union) : node.op == op;
    if (!is_nested || !node.name.empty()) {
      children.push_back(child);
      return;
    }
    children.insert(children.end(), node.children.begin(), node.children.end());
  }

  int finish(const Node& node, std::vector<int> children) {
    if (children.empty()) return kNothing;
    if (children.size() > 1) return out_.add_node(node.op, std::move(children), node.name);
    const int only = children[0];
    if (node.name.empty()) return only;
    if (!out_.nodes[only].name.empty()) return out_.add_node(Op::Union, {only}, node.name);
    out_.nodes[only].name = node.name;
    return only;
  }

  /// Keeps what the root reaches, in depth-first order.
  static Tree compacted(Tree tree) {
    Tree out;
    if (!tree.is_empty()) out.root = move_node(tree, tree.root, out);
    return out;
  }

  static int move_node(Tree& from, int index, Tree& to) {
    Node& node = from.nodes[index];
    if (node.op == Op::Literal) {
      const int leaf = to.add_literal(std::move(from.literals[node.literal]));
      to.nodes[leaf].name = std::move(node.name);
      return leaf;
    }
    std::vector<int> children;
    for (const int child : node.children) children.push_back(move_node(from, child, to));
    return to.add_node(node.op, std::move(children), std::move(node.name));
  }

  const Tree& source_;
  Tree out_;
};

/// A rewritten subtree, or its complement when `is_negated`.
struct Signed {
  int node = kNothing;
  bool is_negated = false;
};

/// Carries complements up to the root by De Morgan's rules.
class ComplementRemover {
 public:
  explicit ComplementRemover(const Tree& source) : source_(source) {}

  Tree run() {
    if (source_.is_empty()) return {};
    const Signed root = visit(source_.root);
    out_.root = root.is_negated ? cut_from_box(root.node) : root.node;
    if (out_.root == kNothing) out_ = {};
    return flattened(out_);
  }

 private:
  Signed visit(int index) {
    const Node& node = source_.nodes[index];
    if (node.op == Op::Literal) {
      const int leaf = out_.add_literal(source_.literals[node.literal]);
      out_.nodes[leaf].name = node.name;
      return {leaf, false};
    }
    if (node.children.empty()) return {kNothing, node.op == Op::Complement};
    Signed result = visit(node.children[0]);
    if (node.op == Op::Complement) return {result.node, !result.is_negated};
    for (std::size_t i = 1; i < node.children.size(); ++i) {
      Signed other = visit(node.children[i]);
      if (node.op == Op::Difference) other.is_negated = !other.is_negated;
      result = node.op == Op::Union ? negated(intersect(negated(result), negated(other)))
                                    : intersect(result, other);
    }
    if (!node.name.empty() && !result.is_negated && result.node != kNothing) {
      result.node = out_.add_node(Op::Union, {result.node}, node.name);
    }
    return result;
  }

  static Signed negated(Signed s) { return {s.node, !s.is_negated}; }

  /// The four cases: a*b, a-b, b-a, !(a+b).
  Signed intersect(Signed a, Signed b) {
    if (a.is_negated && b.is_negated) {
      if (a.node == kNothing) return b;
      if (b.node == kNothing) return a;
      return {out_.add_node(Op::Union, {a.node, b.node}), true};
    }
    if (a.is_negated) std::swap(a, b);
    if (a.node == kNothing) return a;
    if (b.node == kNothing) return b.is_negated ? a : b;
    return {out_.add_node(b.is_negated ? Op::Difference : Op::Intersection, {a.node, b.node}),
            false};
  }

  int cut_from_box(int tool) {
    const Box3 all = bounds_of_literals(source_);
    if (all.is_empty()) return kNothing;
    Literal box;
    box.size = all.size() * 3;
    box.origin = all.center() - box.size / 2;
    const int leaf = out_.add_literal(box);
    return tool == kNothing ? leaf : out_.add_node(Op::Difference, {leaf, tool});
  }

  const Tree& source_;
  Tree out_;
};

}  // namespace

Tree flattened(const Tree& tree) { return Flattener(tree).run(); }

Tree without_complements(const Tree& tree) { return ComplementRemover(tree).run(); }

}  // namespace hewn
