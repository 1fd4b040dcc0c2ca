#pragma once
/// A small random generator whose numbers are the same on every compiler, platform and device (the
/// standard's distributions are not). Never call it twice within one expression: the order of
/// evaluation of arguments is the compiler's choice.
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/host_device_function.h"

namespace hewn {

/// SplitMix64 (Steele, Lea, Flood 2014). Copyable; equal states give equal sequences.
class Rng {
 public:
  HEWN_HD explicit Rng(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(mix(seed + 0x9E3779B97F4A7C15ull * (stream + 1))) {}

  HEWN_HD std::uint64_t next() { return mix(state_ += 0x9E3779B97F4A7C15ull); }
  /// Uniform in [0, 1).
  HEWN_HD double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  HEWN_HD double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  /// Uniform in [0, n). Requires: n > 0.
  HEWN_HD std::size_t below(std::size_t n) {
    return static_cast<std::size_t>((static_cast<unsigned __int128>(next()) * n) >> 64);
  }
  HEWN_HD bool coin() { return (next() >> 63) != 0; }
  /// Puts `items` into random order.
  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
  }

 private:
  static HEWN_HD std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace hewn
