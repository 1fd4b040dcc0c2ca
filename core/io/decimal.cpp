#include "core/io/decimal.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace hewn {
namespace {

/// Exact up to 10^22.
double power_of_ten(int n) {
  double p = 1;
  for (int i = 0; i < n; ++i) p *= 10;
  return p;
}

double scaled(double value, int exponent) {
  return exponent < 0 ? value * power_of_ten(-exponent) : value / power_of_ten(exponent);
}

}  // namespace

DecimalGrid::DecimalGrid(double size, double reach, int unit_exponent)
    : unit_exponent_(unit_exponent) {
  const bool is_usable = std::isfinite(size) && size > 0;
  exponent_ = is_usable ? static_cast<int>(std::floor(std::log10(size * 1.0000001) - 6)) : -6;
  exponent_ = std::clamp(exponent_, -250, 250);
  // Doubles carry 15 digits: a finer grid than that far from the origin would print noise.
  while (std::isfinite(reach) && exponent_ < 250 && std::abs(scaled(reach, exponent_)) > 1e15) {
    ++exponent_;
  }
}

std::int64_t DecimalGrid::quantize(double length) const {
  const double steps = scaled(length, exponent_);
  if (!std::isfinite(steps)) return 0;
  return std::llround(std::clamp(steps, -9e18, 9e18));
}

std::string DecimalGrid::text(std::int64_t steps) const {
  return decimal_text(steps, exponent_ - unit_exponent_);
}

double DecimalGrid::step() const { return scaled(1, -exponent_); }

std::string shortest_decimal(double value, double tolerance) {
  constexpr int kMostDigits = 12;
  for (int digits = 0; digits < kMostDigits; ++digits) {
    const double factor = power_of_ten(digits);
    const double rounded = std::round(value * factor);
    if (std::abs(rounded / factor - value) <= tolerance) {
      return decimal_text(static_cast<std::int64_t>(rounded), -digits);
    }
  }
  return decimal_text(std::llround(value * power_of_ten(kMostDigits)), -kMostDigits);
}

std::string decimal_text(std::int64_t digits, int exponent) {
  if (digits == 0) return "0";
  std::string text = std::to_string(digits < 0 ? -digits : digits);
  if (exponent >= 0) {
    text.append(static_cast<std::size_t>(exponent), '0');
  } else {
    const auto decimals = static_cast<std::size_t>(-exponent);
    if (text.size() <= decimals) text.insert(0, decimals + 1 - text.size(), '0');
    text.insert(text.size() - decimals, 1, '.');
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
  }
  return digits < 0 ? "-" + text : text;
}

}  // namespace hewn
