#pragma once
/// Exact rotations from matrices that are rotations only within a tolerance.
#include "core/base/math.h"

namespace hewn {

/// The rotation nearest to a matrix that is nearly one (its polar factor, by Newton's iteration);
/// the matrix itself, to the bit, when only rounding is between them. Keeps mirrors mirrored.
inline Mat3 nearest_rotation(const Mat3& m) {
  constexpr double kRounding = 1e-14;
  constexpr int kRounds = 6;
  Mat3 r = m;
  for (int round = 0; round < kRounds; ++round) {
    if ((r.transpose() * r - Mat3::Identity()).cwiseAbs().maxCoeff() < kRounding) break;
    r = (r + r.inverse().transpose()) / 2;
  }
  return r;
}

}  // namespace hewn
