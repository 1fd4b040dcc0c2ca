#include "core/fit/round_values.h"

#include <doctest/doctest.h>

#include "core/base/math.h"
#include "core/base/rng.h"

namespace hewn {
namespace {

TEST_CASE("values next to a short decimal become exactly that decimal") {
  CHECK(round_value(0.74999904, 3e-6) == 0.75);
  CHECK(round_value(2.2500011, 3e-6) == 2.25);
  CHECK(round_value(-3.4999992, 3e-6) == -3.5);
  CHECK(round_value(749.99904, 3e-3) == 750);
  CHECK(round_value(0.00074999904, 3e-9) == 0.00075);
  CHECK(round_value(2e-7, 1e-6) == 0);
}

TEST_CASE("a value that is not round stays as it is") {
  const double third = 1.0 / 3;
  CHECK(round_value(third, 1e-9) == third);
  CHECK(round_value(0.123456789, 1e-12) == 0.123456789);
  CHECK(round_value(0.75001, 1e-6) == 0.75001);
  CHECK(round_value(1.5, 0) == 1.5);
}

TEST_CASE("rounding never leaves the tolerance") {
  Rng rng(5);
  for (int i = 0; i < 2000; ++i) {
    const double exponent = rng.uniform(-4, 4);
    const double value = rng.uniform(-1, 1) * std::pow(10.0, exponent);
    const double tolerance = std::abs(value) * std::pow(10.0, rng.uniform(-8, -0.1));
    CHECK(std::abs(round_value(value, tolerance) - value) <= tolerance);
  }
}

TEST_CASE("a free value takes the fewest digits that its room allows") {
  CHECK(roundest_value(5.326, 0.75) == 5);
  CHECK(roundest_value(-4.576, 1.125) == -5);
  CHECK(roundest_value(14.2, 3) == doctest::Approx(14));
  CHECK(roundest_value(14.2, 5) == 10);
  CHECK(roundest_value(0.03, 1) == 0);
  CHECK(roundest_value(0.5326, 0.075) == 0.5);
}

TEST_CASE("angles are round in degrees") {
  const double degree = kPi / 180;
  CHECK(round_angle(22.50001 * degree, 1e-4 * degree) == 22.5 * kPi / 180);
  CHECK(round_angle(27.00002 * degree, 1e-4 * degree) == 27 * kPi / 180);
  CHECK(round_angle(27.003 * degree, 1e-6 * degree) == 27.003 * degree);
}

}  // namespace
}  // namespace hewn
