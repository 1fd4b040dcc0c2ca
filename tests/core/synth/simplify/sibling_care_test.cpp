#include "core/synth/simplify/sibling_care.h"

#include <doctest/doctest.h>

#include "core/base/rng.h"

namespace hewn {
namespace {

TEST_CASE("what siblings leave of the care is the same one by one and together") {
  Rng rng(8);
  constexpr std::size_t kCells = 200;
  std::vector<Column> columns;
  for (int k = 0; k < 7; ++k) {
    Column c(padded_words(kCells), 0);
    for (std::size_t i = 0; i < kCells; ++i) {
      if (rng.below(3) != 0) set_bit(c.data(), i);
    }
    columns.push_back(c);
  }
  const CellColumns cells(kCells, columns);
  Column care = cells.all();
  for (std::size_t i = 0; i < kCells; i += 5) care[i / 64] &= ~(Word{1} << (i % 64));
  for (const auto kind : {Formula::Kind::And, Formula::Kind::Or}) {
    for (std::size_t operands = 1; operands <= 7; ++operands) {
      std::vector<Formula> leaves;
      for (std::size_t k = 0; k < operands; ++k) {
        leaves.push_back(Formula::leaf(static_cast<int>(k), k % 3 == 1));
      }
      Formula f;
      f.kind = kind;
      f.children = leaves;
      evaluate(f, cells);
      SiblingCare siblings(f);
      for (std::size_t k = 0; k < operands; ++k) {
        CHECK(siblings.of(k, care) == care_of_child(f, k, care));
      }
      f.children[0] = Formula::leaf(6);
      evaluate(f, cells);
      siblings.renew();
      for (std::size_t k = 0; k < operands; ++k) {
        CHECK(siblings.of(k, care) == care_of_child(f, k, care));
      }
    }
  }
}

}  // namespace
}  // namespace hewn
