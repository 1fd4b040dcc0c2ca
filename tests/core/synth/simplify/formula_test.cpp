#include "core/synth/simplify/formula.h"

#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "core/synth/simplify/redundancy.h"
#include "core/synth/simplify/resynthesise.h"
#include "core/synth/simplify/rewrite_search.h"
#include "formula_fixture.h"

namespace hewn {
namespace {

using testing::all_cells;
using testing::is_normal;
using testing::random_formula;
using testing::same_on;

TEST_CASE("the normal form keeps the value and has no bare complements") {
  Rng rng(1);
  const CellColumns cells = all_cells(5);
  for (int i = 0; i < 2000; ++i) {
    Formula f = random_formula(rng, 5, 4);
    Formula n = normalised(f);
    REQUIRE(same_on(f, n, cells, cells.all()));
    REQUIRE(is_normal(n));
    REQUIRE(leaf_count(n) <= leaf_count(f));
  }
}

TEST_CASE("a formula becomes a binary tree of the promised size and proximity") {
  Rng rng(2);
  const CellColumns cells = all_cells(5);
  std::vector<Literal> literals(5);
  const std::vector<int> same = {0, 1, 2, 3, 4};
  for (int i = 0; i < 500; ++i) {
    const Formula f = normalised(random_formula(rng, 5, 4));
    const Tree tree = to_tree(f, literals, cells);
    REQUIRE(tree_size(tree) == formula_size(f));
    std::vector<int> literal_of;
    for (const Node& node : tree.nodes) {
      REQUIRE(node.children.size() <= 2);
    }
    // Literals are copied in the order of the leaves: find each one's column by the formula.
    std::vector<int> leaves;
    testing::leaves_in_tree_order(tree, f, cells, leaves);
    REQUIRE(leaves.size() == tree.literals.size());
    REQUIRE(same_on(formula_of(tree, leaves), f, cells, cells.all()));
    REQUIRE(tree_proximity(tree, leaves, cells) == doctest::Approx(formula_proximity(f, cells)));
  }
}

TEST_CASE("each rule of redundancy removal applies") {
  // Cells: three literals, b inside a, c apart from both.
  std::vector<Column> columns(3, Column(padded_words(4), 0));
  const int rows[4] = {0b000, 0b001, 0b011, 0b100};
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t k = 0; k < 3; ++k) {
      if ((rows[c] >> k) & 1) set_bit(columns[k].data(), c);
    }
  }
  const CellColumns cells(4, columns);
  const auto reduced = [&](Formula::Kind kind, int left, int right, bool is_difference) {
    std::vector<Formula> parts;
    parts.push_back(Formula::leaf(left));
    parts.push_back(Formula::leaf(right, is_difference));
    return without_redundancy(Formula::join(kind, std::move(parts)), cells, cells.all(), {});
  };
  using Kind = Formula::Kind;
  const Formula contained = reduced(Kind::Or, 0, 1, false);
  CHECK(contained.kind == Kind::Leaf);
  CHECK(contained.literal == 0);
  const Formula narrower = reduced(Kind::And, 0, 1, false);
  CHECK(narrower.literal == 1);
  CHECK(reduced(Kind::And, 0, 2, false).is_constant());  // disjoint
  const Formula disjoint_tool = reduced(Kind::And, 0, 2, true);
  CHECK(disjoint_tool.kind == Kind::Leaf);
  CHECK(disjoint_tool.literal == 0);
  const Formula swallowed = reduced(Kind::And, 1, 0, true);
  CHECK(swallowed.is_constant());
  CHECK_FALSE(swallowed.is_negated);
  CHECK(leaf_count(reduced(Kind::And, 0, 1, true)) == 2);  // nothing to remove
}

TEST_CASE("redundancy removal keeps the value where it matters and never grows") {
  Rng rng(3);
  const CellColumns cells = all_cells(6);
  for (int i = 0; i < 400; ++i) {
    const Formula f = random_formula(rng, 6, 5);
    const Column care = testing::random_column(rng, cells);
    RedundancyCounts counts;
    const Formula r = without_redundancy(f, cells, care, {}, &counts);
    REQUIRE(same_on(f, r, cells, care));
    REQUIRE(leaf_count(r) <= leaf_count(f));
    REQUIRE(is_normal(r));
    const Formula again = without_redundancy(r, cells, care, {});
    REQUIRE(leaf_count(again) == leaf_count(r));
  }
}

TEST_CASE("resynthesis fills its task within its budget") {
  Rng rng(4);
  const CellColumns cells = all_cells(6);
  Resynthesis resynthesis(cells);
  int found = 0;
  for (int i = 0; i < 400; ++i) {
    Formula f = random_formula(rng, 6, 3);
    const Column wanted = evaluate(f, cells);
    const Column care = testing::random_column(rng, cells);
    CellTask task{care, care};
    for (std::size_t w = 0; w < care.size(); ++w) {
      task.on[w] &= wanted[w];
      task.off[w] &= ~wanted[w];
    }
    const auto made = resynthesis.attempt(task, leaf_count(f), rng);
    if (!made) continue;
    ++found;
    REQUIRE(leaf_count(*made) <= leaf_count(f));
    REQUIRE(same_on(f, *made, cells, care));
  }
  CHECK(found > 200);
}

TEST_CASE("the rewrite search keeps the value and undoes what was inflated") {
  Rng rng(5);
  const CellColumns cells = all_cells(6);
  int smaller = 0;
  for (int i = 0; i < 60; ++i) {
    const Formula f = normalised(random_formula(rng, 6, 5));
    const Formula r = rewrite_search(f, cells, cells.all(), {}, {});
    REQUIRE(same_on(f, r, cells, cells.all()));
    REQUIRE(leaf_count(r) <= leaf_count(f));
    smaller += leaf_count(r) < leaf_count(f) ? 1 : 0;
  }
  CHECK(smaller > 20);
}

}  // namespace
}  // namespace hewn
