#include "core/fit/round_values.h"

#include <cmath>

#include "core/base/math.h"

namespace hewn {
namespace {

// A step this much coarser than the tolerance is hit by chance once in ten times.
constexpr double kMinStep = 20;

/// Among the multiples of powers of ten of `least_step` and more.
RoundValue find_round(double value, double tolerance, double least_step) {
  if (!(tolerance > 0) || !std::isfinite(tolerance) || !std::isfinite(value)) return {value};
  if (std::abs(value) <= tolerance) return {0, 1000};
  const int first = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  const int last = static_cast<int>(std::floor(std::log10(least_step)));
  for (int exponent = first; exponent >= last; --exponent) {
    // Dividing by an exact power of ten gives the double nearest to the decimal.
    const double unit = std::pow(10.0, std::abs(exponent));
    const double rounded =
        exponent < 0 ? std::round(value * unit) / unit : std::round(value / unit) * unit;
    if (std::abs(rounded - value) <= tolerance) return {rounded, exponent};
  }
  return {value};
}

}  // namespace

RoundValue find_round_value(double value, double tolerance) {
  return find_round(value, tolerance, kMinStep * tolerance);
}

double roundest_value(double value, double tolerance) {
  return find_round(value, tolerance, tolerance).value;
}

double round_value(double value, double tolerance) {
  return find_round_value(value, tolerance).value;
}

RoundValue find_round_angle(double angle_rad, double tolerance_rad) {
  const double degrees = angle_rad * 180 / kPi;
  RoundValue found = find_round_value(degrees, tolerance_rad * 180 / kPi);
  found.value = found.value == degrees ? angle_rad : found.value * kPi / 180;
  return found;
}

double round_angle(double angle_rad, double tolerance_rad) {
  return find_round_angle(angle_rad, tolerance_rad).value;
}

}  // namespace hewn
