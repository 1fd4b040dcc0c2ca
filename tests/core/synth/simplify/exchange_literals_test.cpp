#include "core/synth/simplify/exchange_literals.h"

#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "formula_fixture.h"

namespace hewn {
namespace {

using testing::all_cells;
using testing::random_formula;
using testing::same_on;

TEST_CASE("exchanged literals keep the value and the size and never lower the proximity") {
  Rng rng(7);
  const CellColumns cells = all_cells(6);
  int raised = 0;
  for (int i = 0; i < 400; ++i) {
    const Formula f = normalised(random_formula(rng, 6, 4));
    Column care = testing::random_column(rng, cells);
    for (Word& w : care) w &= rng.next();  // few cells: literals can take each other's place
    const Formula g = exchange_literals(f, cells, care, {});
    REQUIRE(same_on(f, g, cells, care));
    REQUIRE(formula_size(g) == formula_size(f));
    REQUIRE(formula_proximity(g, cells) >= formula_proximity(f, cells));
    raised += formula_proximity(g, cells) > formula_proximity(f, cells) ? 1 : 0;
  }
  CHECK(raised > 0);
}

TEST_CASE("a bore that ends at the pin in it lets the pin overlap the plate") {
  // Cells along the axis: the plate's rim, the pin in the plate, the bore above it, the pin below.
  const auto column = [](Word bits) {
    Column c(padded_words(4), 0);
    c[0] = bits;
    return c;
  };
  const Column plate = column(0b0111);
  const Column bore = column(0b1110);
  const Column pin = column(0b1010);
  const Column short_bore = column(0b0100);
  const CellColumns cells(4, {plate, bore, pin, short_bore});
  std::vector<Formula> ring;
  ring.push_back(Formula::leaf(0));
  ring.push_back(Formula::leaf(1, true));
  std::vector<Formula> both;
  both.push_back(Formula::join(Formula::Kind::And, std::move(ring)));
  both.push_back(Formula::leaf(2));
  const Formula f = Formula::join(Formula::Kind::Or, std::move(both));
  REQUIRE(formula_proximity(f, cells) == doctest::Approx(0.8));
  const Formula g = exchange_literals(f, cells, cells.all(), {});
  CHECK(formula_proximity(g, cells) == doctest::Approx(1));
  CHECK(g.children[0].children[1].literal == 3);
}

}  // namespace
}  // namespace hewn
