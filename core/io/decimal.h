#pragma once
/// Lengths and angles as the short decimals that a person would type.
#include <cstdint>
#include <string>

namespace hewn {

/// Rounds lengths to a decimal grid of 1e-7 to 1e-6 of a model's size. Work on the integers
/// (`hi - lo` is then exact) and print last.
class DecimalGrid {
 public:
  /// `size`: the model's bounding-box diagonal; `reach`: the largest absolute coordinate.
  /// Printed numbers are in units of 10^unit_exponent model units.
  DecimalGrid(double size, double reach, int unit_exponent = 0);

  /// The multiple of the grid step nearest to `length` (model units); 0 when it is not finite.
  std::int64_t quantize(double length) const;
  /// The exact decimal, without trailing zeros or exponent.
  std::string text(std::int64_t steps) const;
  /// In model units.
  double step() const;

 private:
  int exponent_;
  int unit_exponent_;
};

/// The shortest decimal within `tolerance` of `value`; at most 12 digits behind the point.
std::string shortest_decimal(double value, double tolerance);

/// `digits * 10^exponent` without trailing zeros or exponent.
std::string decimal_text(std::int64_t digits, int exponent);

}  // namespace hewn
