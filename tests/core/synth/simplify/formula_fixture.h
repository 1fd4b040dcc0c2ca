#pragma once
/// Formulas over all combinations of a few literals, and random ones.
#include <vector>

#include "core/base/rng.h"
#include "core/synth/simplify/formula.h"

namespace hewn::testing {

/// One cell for every combination of the literals.
inline CellColumns all_cells(int literals) {
  const std::size_t cells = std::size_t{1} << literals;
  std::vector<Column> columns(static_cast<std::size_t>(literals), Column(padded_words(cells), 0));
  for (std::size_t c = 0; c < cells; ++c) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if ((c >> k) & 1) set_bit(columns[k].data(), c);
    }
  }
  return {cells, std::move(columns)};
}

inline Formula random_formula(Rng& rng, int literals, int depth) {
  Formula f;
  const std::size_t choice = rng.below(8);
  if (depth == 0 || choice == 0) {
    f = choice == 7 && rng.below(4) == 0
            ? Formula::constant(rng.coin())
            : Formula::leaf(static_cast<int>(rng.below(static_cast<std::size_t>(literals))));
  } else {
    std::vector<Formula> children;
    const std::size_t count = 1 + rng.below(3);
    for (std::size_t i = 0; i < count; ++i) {
      children.push_back(random_formula(rng, literals, depth - 1));
    }
    f = Formula::join(rng.coin() ? Formula::Kind::And : Formula::Kind::Or, std::move(children));
  }
  if (rng.below(3) == 0) f.is_negated = !f.is_negated;
  return f;
}

inline Column random_column(Rng& rng, const CellColumns& cells) {
  Column column = cells.all();
  for (Word& w : column) {
    const Word mask = rng.next();
    w &= mask;
  }
  return column;
}

inline bool same_on(Formula a, Formula b, const CellColumns& cells, const Column& care) {
  evaluate(a, cells);
  evaluate(b, cells);
  return count_differences(a.value, b.value, care) == 0;
}

/// No constants within, kinds alternate, and only the root may be a bare complement.
inline bool is_normal(const Formula& f) {
  if (f.kind == Formula::Kind::Empty || f.kind == Formula::Kind::Leaf) return true;
  if (f.children.size() < 2) return false;
  bool has_positive = false;
  for (const Formula& child : f.children) {
    if (child.is_constant() || !is_normal(child)) return false;
    if (child.kind == f.kind && !child.is_negated) return false;
    if (f.kind == Formula::Kind::Or && child.is_negated) return false;
    has_positive = has_positive || !child.is_negated;
  }
  return has_positive;
}

/// The column of every literal of the tree, by the marks that `marked` literals carry.
inline void leaves_in_tree_order(const Tree&, const Formula& formula, const CellColumns& cells,
                                 std::vector<int>& leaves) {
  std::vector<Literal> marked(static_cast<std::size_t>(cells.literals()));
  for (std::size_t k = 0; k < marked.size(); ++k) {
    marked[k].kind = SolidKind::Sphere;
    marked[k].radius = static_cast<double>(k);
  }
  const Tree tree = to_tree(formula, marked, cells);
  for (const Literal& s : tree.literals) leaves.push_back(static_cast<int>(s.radius));
}

}  // namespace hewn::testing
