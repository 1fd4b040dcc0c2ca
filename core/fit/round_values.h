#pragma once
/// Snapping measured values to the round ones that a designer types.
namespace hewn {

struct RoundValue {
  static constexpr int kNotRounded = -1000;

  double value = 0;
  int exponent = kNotRounded;  ///< the value is a multiple of ten to this power
  bool is_round() const { return exponent != kNotRounded; }
};

/// The decimal with the fewest digits within `tolerance` of `value`, or `value` itself when no
/// decimal much coarser than the tolerance is that close. Decimal places count relative to powers
/// of ten, so that a part in metres rounds like one in millimetres. Never moves further than
/// `tolerance`.
double round_value(double value, double tolerance);

/// The decimal with the fewest digits within `tolerance` of `value`, for a value that nothing tells
/// more exactly: however coarse it is.
double roundest_value(double value, double tolerance);

/// `round_value`, and how round it is.
RoundValue find_round_value(double value, double tolerance);

/// The same for an angle, rounded in degrees.
double round_angle(double angle_rad, double tolerance_rad);

/// `round_angle`, and how round it is: the exponent counts in degrees.
RoundValue find_round_angle(double angle_rad, double tolerance_rad);

}  // namespace hewn
