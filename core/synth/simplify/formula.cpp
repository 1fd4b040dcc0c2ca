#include "core/synth/simplify/formula.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/assert.h"

namespace hewn {
namespace {

using Kind = Formula::Kind;

Kind dual(Kind kind) { return kind == Kind::And ? Kind::Or : Kind::And; }

void negate(Formula& f) { f.is_negated = !f.is_negated; }

/// Turns a negated union or intersection into its dual by De Morgan's rules.
void push_negation(Formula& f) {
  f.is_negated = false;
  f.kind = dual(f.kind);
  for (Formula& child : f.children) negate(child);
}

/// Appends `child` to the operands of an operation, merging it when it is of the same kind.
/// False when it decides the whole operation.
bool append(Kind kind, Formula child, std::vector<Formula>& out) {
  if (child.is_constant()) {
    const bool is_everything = child.is_negated;
    return (kind == Kind::And) == is_everything;
  }
  if (child.kind != Kind::Leaf && child.is_negated && child.kind == dual(kind)) {
    push_negation(child);
  }
  if (child.kind == kind && !child.is_negated) {
    for (Formula& c : child.children) {
      if (!append(kind, std::move(c), out)) return false;
    }
    return true;
  }
  out.push_back(std::move(child));
  return true;
}

Formula from_node(const Tree& tree, int index, std::span<const int> literal_of) {
  const Node& node = tree.nodes[index];
  if (node.op == Op::Literal)
    return Formula::leaf(literal_of[static_cast<std::size_t>(node.literal)]);
  std::vector<Formula> children;
  for (const int child : node.children) children.push_back(from_node(tree, child, literal_of));
  if (node.op == Op::Complement) {
    if (children.empty()) return Formula::constant(true);
    negate(children[0]);
    return std::move(children[0]);
  }
  if (children.empty()) return Formula::constant(false);
  if (node.op == Op::Union) return Formula::join(Kind::Or, std::move(children));
  for (std::size_t i = 1; i < children.size() && node.op == Op::Difference; ++i) {
    negate(children[i]);
  }
  return Formula::join(Kind::And, std::move(children));
}

/// A subtree under construction: its node, the cells that it fills and its part of the proximity.
class Built {
 public:
  /// A literal's column is read where it stands; it must outlive this.
  static Built leaf(int node, const Column& column) {
    Built b;
    b.node = node;
    b.proximity = 1;
    b.value_ = column;
    return b;
  }
  static Built empty(const CellColumns& cells) {
    Built b;
    b.own_ = cells.empty();
    b.value_ = b.own_;
    return b;
  }
  Built(const Built&) = delete;
  Built& operator=(const Built&) = delete;
  Built(Built&&) = default;
  Built& operator=(Built&&) = default;

  std::span<const Word> value() const { return value_; }
  /// The cells, to be changed.
  Column& own_value() {
    if (own_.empty()) own_.assign(value_.begin(), value_.end());
    value_ = own_;
    return own_;
  }

  int node = -1;
  int proximity = 0;

 private:
  Built() = default;

  std::span<const Word> value_;  ///< of a literal, or all of `own_`
  Column own_;
};

/// Joins `right` to `left` by a binary operation and counts their overlap.
void join_values(Op op, Built& left, const Built& right) {
  left.proximity += right.proximity + (intersects(left.value(), right.value()) ? 1 : 0);
  Column& value = left.own_value();
  for (std::size_t i = 0; i < value.size(); ++i) {
    const Word r = right.value()[i];
    value[i] = op == Op::Union          ? value[i] | r
               : op == Op::Intersection ? value[i] & r
                                        : value[i] & ~r;
  }
}

/// Those that at least two of the parts hold.
Column cells_of_several(const std::vector<Built>& parts) {
  Column one(parts[0].value().size(), 0);
  Column several = one;
  for (const Built& part : parts) {
    for (std::size_t i = 0; i < one.size(); ++i) {
      several[i] |= one[i] & part.value()[i];
      one[i] |= part.value()[i];
    }
  }
  return several;
}

Built measured(const Tree& tree, int index, std::span<const int> literal_of,
               const CellColumns& cells) {
  const Node& node = tree.nodes[index];
  if (node.op == Op::Literal) {
    return Built::leaf(-1, cells.column(literal_of[static_cast<std::size_t>(node.literal)]));
  }
  if (node.children.empty()) return Built::empty(cells);
  Built result = measured(tree, node.children[0], literal_of, cells);
  if (node.op == Op::Complement) {
    ++result.proximity;
    Column& value = result.own_value();
    for (std::size_t i = 0; i < value.size(); ++i) value[i] = cells.all()[i] & ~value[i];
    return result;
  }
  for (std::size_t i = 1; i < node.children.size(); ++i) {
    join_values(node.op, result, measured(tree, node.children[i], literal_of, cells));
  }
  return result;
}

/// Writes a formula as a binary tree. Without literals only the proximity is counted.
class TreeMaker {
 public:
  TreeMaker(const std::vector<Literal>* literals, const CellColumns& cells)
      : literals_(literals), cells_(cells) {}

  Tree run(const Formula& formula) {
    if (formula.is_constant()) {
      if (formula.is_negated) {
        tree_.root = tree_.add_node(Op::Complement, {tree_.add_node(Op::Union, {})});
      }
      return std::move(tree_);
    }
    Built built = positive(formula);
    proximity_ = built.proximity;
    if (formula.is_negated) {
      built.node = add(Op::Complement, {built.node});
      ++proximity_;
    }
    tree_.root = built.node;
    return std::move(tree_);
  }
  int proximity() const { return proximity_; }

 private:
  int add(Op op, std::vector<int> children) {
    return literals_ ? tree_.add_node(op, std::move(children)) : -1;
  }

  /// The node without its own negation.
  Built positive(const Formula& f) {
    if (f.kind == Kind::Leaf) {
      const auto literal = static_cast<std::size_t>(f.literal);
      return Built::leaf(literals_ ? tree_.add_literal((*literals_)[literal]) : -1,
                         cells_.column(f.literal));
    }
    std::vector<Built> kept;
    std::vector<Built> cut;
    for (const Formula& child : f.children) {
      (child.is_negated ? cut : kept).push_back(positive(child));
    }
    // A formula in normal form has an operand to start from.
    HEWN_ASSERT(!kept.empty(), "an operation needs an operand that is not negated");
    Built result = folded(f.kind == Kind::And ? Op::Intersection : Op::Union, std::move(kept));
    for (Built& tool : ordered(result.value(), std::move(cut))) {
      join(Op::Difference, result, tool);
    }
    return result;
  }

  /// Next is always the first part that overlaps what is there; the order of the formula otherwise.
  Built folded(Op op, std::vector<Built> parts) {
    std::vector<std::size_t> rest(parts.size() - 1);
    std::iota(rest.begin(), rest.end(), std::size_t{1});
    // Most of many parts stand alone.
    const Column shared = cells_of_several(parts);
    std::vector<char> may_overlap;
    for (const std::size_t i : rest) {
      may_overlap.push_back(intersects(parts[i].value(), shared) ? 1 : 0);
    }
    Built result = std::move(parts[0]);
    while (!rest.empty()) {
      std::size_t next = 0;
      for (std::size_t i = 0; i < rest.size(); ++i) {
        if (!may_overlap[i] || !intersects(parts[rest[i]].value(), result.value())) continue;
        next = i;
        break;
      }
      join(op, result, parts[rest[next]]);
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(next));
      may_overlap.erase(may_overlap.begin() + static_cast<std::ptrdiff_t>(next));
    }
    return result;
  }

  /// Tools that overlap the solid first: later ones may no longer.
  static std::vector<Built> ordered(std::span<const Word> solid, std::vector<Built> tools) {
    std::stable_partition(tools.begin(), tools.end(),
                          [&](const Built& t) { return intersects(t.value(), solid); });
    return tools;
  }

  void join(Op op, Built& left, const Built& right) {
    left.node = add(op, {left.node, right.node});
    join_values(op, left, right);
  }

  const std::vector<Literal>* literals_;
  const CellColumns& cells_;
  Tree tree_;
  int proximity_ = 0;
};

}  // namespace

CellColumns::CellColumns(const Arrangement& arrangement) : cells_(arrangement.size()) {
  const std::size_t words = padded_words(cells_);
  all_.assign(words, 0);
  columns_.assign(arrangement.literals.size(), Column(words, 0));
  for (std::size_t c = 0; c < cells_; ++c) {
    set_bit(all_.data(), c);
    for_each_bit({arrangement.signature(c), arrangement.stride},
                 [&](std::size_t k) { set_bit(columns_[k].data(), c); });
  }
}

CellColumns::CellColumns(std::size_t cells, std::vector<Column> columns)
    : cells_(cells), columns_(std::move(columns)) {
  all_.assign(padded_words(cells), 0);
  for (std::size_t c = 0; c < cells; ++c) set_bit(all_.data(), c);
}

Formula Formula::leaf(int literal, bool is_negated) {
  Formula f;
  f.kind = Kind::Leaf;
  f.literal = literal;
  f.is_negated = is_negated;
  return f;
}

Formula Formula::constant(bool is_everything) {
  Formula f;
  f.is_negated = is_everything;
  return f;
}

Formula Formula::join(Kind kind, std::vector<Formula> children) {
  Formula f;
  f.kind = kind;
  f.children = std::move(children);
  return f;
}

int leaf_count(const Formula& f) {
  if (f.kind == Kind::Leaf) return 1;
  int n = 0;
  for (const Formula& child : f.children) n += leaf_count(child);
  return n;
}

int formula_size(const Formula& f) {
  const int leaves = leaf_count(f);
  if (leaves == 0) return f.is_negated ? 1 : 0;
  return 2 * leaves - 1 + (f.is_negated ? 1 : 0);
}

Formula normalised(Formula f) {
  f.value.clear();
  if (f.kind == Kind::Empty || f.kind == Kind::Leaf) return f;
  std::vector<Formula> children;
  for (Formula& child : f.children) {
    if (append(f.kind, normalised(std::move(child)), children)) continue;
    return Formula::constant((f.kind == Kind::Or) != f.is_negated);
  }
  // Nothing left: the neutral element.
  if (children.empty()) return Formula::constant((f.kind == Kind::And) != f.is_negated);
  if (children.size() == 1) {
    if (f.is_negated) negate(children[0]);
    return std::move(children[0]);
  }
  f.children = std::move(children);
  const auto is_negative = [](const Formula& c) { return c.is_negated; };
  const bool must_turn = f.kind == Kind::Or
                             ? std::any_of(f.children.begin(), f.children.end(), is_negative)
                             : std::all_of(f.children.begin(), f.children.end(), is_negative);
  if (must_turn) {
    const bool was_negated = f.is_negated;
    push_negation(f);
    f.is_negated = !was_negated;
    // Children may now be of the same kind as the node.
    std::vector<Formula> merged;
    for (Formula& child : f.children) append(f.kind, std::move(child), merged);
    f.children = std::move(merged);
  }
  return f;
}

const Column& evaluate(Formula& f, const CellColumns& cells) {
  if (f.kind == Kind::Empty) {
    f.value = cells.empty();
  } else if (f.kind == Kind::Leaf) {
    f.value = cells.column(f.literal);
  } else {
    f.value = f.kind == Kind::And ? cells.all() : cells.empty();
    for (Formula& child : f.children) {
      const Column& v = evaluate(child, cells);
      for (std::size_t i = 0; i < v.size(); ++i) {
        f.value[i] = f.kind == Kind::And ? f.value[i] & v[i] : f.value[i] | v[i];
      }
    }
  }
  if (f.is_negated) {
    for (std::size_t i = 0; i < f.value.size(); ++i) f.value[i] = cells.all()[i] & ~f.value[i];
  }
  return f.value;
}

Formula formula_of(const Tree& tree, std::span<const int> literal_of) {
  if (tree.is_empty()) return Formula::constant(false);
  return normalised(from_node(tree, tree.root, literal_of));
}

Tree to_tree(const Formula& formula, const std::vector<Literal>& literals,
             const CellColumns& cells) {
  return TreeMaker(&literals, cells).run(formula);
}

double formula_proximity(const Formula& formula, const CellColumns& cells) {
  if (formula.is_constant()) return 1;
  TreeMaker maker(nullptr, cells);
  maker.run(formula);
  return static_cast<double>(maker.proximity()) / formula_size(formula);
}

double tree_proximity(const Tree& tree, std::span<const int> literal_of, const CellColumns& cells) {
  const int size = tree_size(tree);
  if (size == 0) return 1;
  return static_cast<double>(measured(tree, tree.root, literal_of, cells).proximity) / size;
}

Column differences(const Column& a, const Column& b, const Column& mask) {
  Column out = mask;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] &= a[i] ^ b[i];
  return out;
}

std::size_t count_differences(const Column& a, const Column& b, const Column& mask) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    n += static_cast<std::size_t>(std::popcount((a[i] ^ b[i]) & mask[i]));
  }
  return n;
}

bool intersects(std::span<const Word> a, std::span<const Word> b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if ((a[i] & b[i]) != 0) return true;
  }
  return false;
}

}  // namespace hewn
