#pragma once
/// The way the literature evaluates a tree: min and max over signed distances. Baseline for
/// `BitProgram`, with the same steps, the same blocking and hand-written vector code, so that the
/// comparison is of floats with bits and of nothing else.
#include <cstddef>
#include <span>

#include "core/compute/bit_program.h"

namespace hewn::bench {

/// Floats evaluated at a time: of 128, 512 and 2048 the fastest at 65,536 points (AVX2).
inline constexpr std::size_t kFloatBlock = 128;

/// For how many points the sign of the formula's distance differs from the wanted one's.
/// Requires: a complete formula; `points` a multiple of 16; the path is available.
int count_differing_signs(const BitProgram& program, std::span<const float* const> distances,
                          const float* wanted, std::size_t points, BitPath path);

}  // namespace hewn::bench
