#include "core/io/decimal.h"

#include <cmath>
#include <cstdlib>

#include <doctest/doctest.h>

#include "core/base/rng.h"

namespace hewn {
namespace {

TEST_CASE("a value that is round within the grid prints round") {
  const DecimalGrid grid(17.3, 17.3);
  CHECK(grid.text(grid.quantize(0.74999904)) == "0.75");
  CHECK(grid.text(grid.quantize(-5.0000001)) == "-5");
  CHECK(grid.text(grid.quantize(10.0 / 3)) == "3.33333");
  CHECK(grid.text(grid.quantize(-1e-9)) == "0");
  CHECK(grid.text(grid.quantize(120)) == "120");
}

TEST_CASE("the grid follows the model's size") {
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const double size = std::pow(10.0, rng.uniform(-9, 9));
    const DecimalGrid grid(size, size);
    CHECK(grid.step() <= size * 1.001e-6);
    CHECK(grid.step() >= size * 0.999e-7);
    const double value = rng.uniform(-size, size);
    const double printed = std::strtod(grid.text(grid.quantize(value)).c_str(), nullptr);
    CHECK(std::abs(printed - value) <= grid.step() * 0.501);
  }
}

TEST_CASE("printed lengths can be in other units than the model's") {
  const DecimalGrid grid(0.0173, 0.0173, -3);
  CHECK(grid.text(grid.quantize(0.00075)) == "0.75");
  const DecimalGrid huge(17300, 17300);
  CHECK(huge.text(huge.quantize(5000.0001)) == "5000");
}

TEST_CASE("numbers that cannot be printed become zero instead of nonsense") {
  const DecimalGrid grid(1, 1);
  CHECK(grid.text(grid.quantize(std::nan(""))) == "0");
  CHECK(grid.text(grid.quantize(HUGE_VAL)) == "0");
  CHECK(DecimalGrid(0, 0).step() == doctest::Approx(1e-6));
}

TEST_CASE("the shortest decimal within the tolerance is chosen") {
  CHECK(shortest_decimal(26.9999999, 1e-6) == "27");
  CHECK(shortest_decimal(-22.5, 1e-6) == "-22.5");
  CHECK(shortest_decimal(1.0 / 3, 1e-4) == "0.3333");
  CHECK(shortest_decimal(1e-9, 1e-6) == "0");
  CHECK(shortest_decimal(0.30000000000000004, 0) == "0.3");
}

TEST_CASE("decimals carry no exponent and no trailing zeros") {
  CHECK(decimal_text(1500, -2) == "15");
  CHECK(decimal_text(-5, -3) == "-0.005");
  CHECK(decimal_text(12, 3) == "12000");
  CHECK(decimal_text(0, -6) == "0");
}

}  // namespace
}  // namespace hewn
