#pragma once
/// Trees as strings.
#include <cstdint>

namespace hewn {

/// A tree in postfix order: a column's number at or above 0, or one of the operations below. A
/// difference's second operand is the topmost; a complement has one.
using Token = std::int16_t;
inline constexpr Token kUnionToken = -1;
inline constexpr Token kIntersectionToken = -2;
inline constexpr Token kDifferenceToken = -3;
inline constexpr Token kComplementToken = -4;

}  // namespace hewn
