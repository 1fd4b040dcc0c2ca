#pragma once
/// Trees as Boolean formulas over the cells of an arrangement: the form in which all optimisation
/// methods work.
#include <span>
#include <utility>
#include <vector>

#include "core/compute/bits.h"
#include "core/csg/tree.h"
#include "core/sample/arrangement.h"

namespace hewn {

/// One bit per cell, `padded_words(cells)` long, zero beyond the last cell.
using Column = std::vector<Word>;

/// The cells of an arrangement as bit columns over its literals.
class CellColumns {
 public:
  explicit CellColumns(const Arrangement& arrangement);
  /// Cells given by the literals' columns themselves, for tests.
  CellColumns(std::size_t cells, std::vector<Column> columns);

  /// Appends a column; it becomes the literal with the next index.
  void add(Column column) { columns_.push_back(std::move(column)); }

  std::size_t cells() const { return cells_; }
  std::size_t words() const { return all_.size(); }
  int literals() const { return static_cast<int>(columns_.size()); }
  const Column& column(int literal) const { return columns_[static_cast<std::size_t>(literal)]; }
  const Column& all() const { return all_; }
  Column empty() const {
    Column none(words(), 0);
    return none;
  }

 private:
  std::size_t cells_ = 0;
  std::vector<Column> columns_;
  Column all_;
};

/// A formula in normal form: unions and intersections alternate, any node may be negated.
/// `Empty` negated is everything.
struct Formula {
  enum class Kind { Empty, Leaf, And, Or };
  Kind kind = Kind::Empty;
  bool is_negated = false;
  int literal = -1;
  std::vector<Formula> children;
  Column value;  ///< of the last `evaluate`, negation included

  static Formula leaf(int literal, bool is_negated = false);
  static Formula constant(bool is_everything);
  static Formula join(Kind kind, std::vector<Formula> children);
  bool is_constant() const { return kind == Kind::Empty; }
};

/// Literals in it. Its binary tree has 2 n - 1 nodes, and one more when the solid is unbounded.
int leaf_count(const Formula& formula);

/// Nodes of the binary tree that `to_tree` makes.
int formula_size(const Formula& formula);

/// Merges nested operations of one kind, removes constants and single children, and moves negations
/// so that no node but the root is a bare complement: a union has no negated child and an
/// intersection has one that is not. Values are dropped.
Formula normalised(Formula formula);

/// Computes and stores `value` in every node. Cost: O(nodes x words).
const Column& evaluate(Formula& formula, const CellColumns& cells);

/// The tree as a formula; `literal_of[i]` is the column of the tree's literal i. Normalised.
Formula formula_of(const Tree& tree, std::span<const int> literal_of);

/// The formula as a binary tree over `literals`, its operands ordered so that as many as possible
/// overlap (the spatial sorting of Friedrich et al. 2020, section 5.2).
Tree to_tree(const Formula& formula, const std::vector<Literal>& literals,
             const CellColumns& cells);

/// The proximity of `to_tree`'s tree, over cells.
double formula_proximity(const Formula& formula, const CellColumns& cells);

/// The proximity of a tree as it stands, over cells; n-ary nodes count as their left fold.
double tree_proximity(const Tree& tree, std::span<const int> literal_of, const CellColumns& cells);

/// The cells of `mask` on which two columns differ.
Column differences(const Column& a, const Column& b, const Column& mask);

/// Cells of `mask` where two columns differ.
std::size_t count_differences(const Column& a, const Column& b, const Column& mask);

/// Whether `a & b` is not empty.
bool intersects(std::span<const Word> a, std::span<const Word> b);

}  // namespace hewn
