#include "bench/micro/float_program.h"

#include <algorithm>
#include <array>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#define HEWN_X86 1
#endif

namespace hewn::bench {
namespace {

struct FloatKernels {
  /// Indexed by `BitOp`; `out` may be `a` or `b`.
  std::array<void (*)(const float* a, const float* b, float* out, std::size_t n), 4> combine;
  int (*count_differing)(const float* a, const float* b, std::size_t n);
};

namespace portable {
template <BitOp kOp>
void combine(const float* a, const float* b, float* out, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    if constexpr (kOp == BitOp::And) out[i] = a[i] > b[i] ? a[i] : b[i];
    if constexpr (kOp == BitOp::Or) out[i] = a[i] < b[i] ? a[i] : b[i];
    if constexpr (kOp == BitOp::AndNot) out[i] = a[i] > -b[i] ? a[i] : -b[i];
    if constexpr (kOp == BitOp::Not) out[i] = -a[i];
  }
}

int count_differing(const float* a, const float* b, std::size_t n) {
  int count = 0;
  for (std::size_t i = 0; i < n; ++i) count += (a[i] < 0) != (b[i] < 0) ? 1 : 0;
  return count;
}

constexpr FloatKernels kKernels{
    {combine<BitOp::And>, combine<BitOp::Or>, combine<BitOp::AndNot>, combine<BitOp::Not>},
    count_differing};
}  // namespace portable

#ifdef HEWN_X86
namespace avx2 {
#define HEWN_TARGET __attribute__((target("avx2,popcnt")))

template <BitOp kOp>
HEWN_TARGET inline __m256 apply(__m256 a, __m256 b) {
  const __m256 sign = _mm256_set1_ps(-0.0f);
  if constexpr (kOp == BitOp::And) return _mm256_max_ps(a, b);
  if constexpr (kOp == BitOp::Or) return _mm256_min_ps(a, b);
  if constexpr (kOp == BitOp::AndNot) return _mm256_max_ps(a, _mm256_xor_ps(b, sign));
  return _mm256_xor_ps(a, sign);
}

template <BitOp kOp>
HEWN_TARGET void combine(const float* a, const float* b, float* out, std::size_t n) {
  for (std::size_t i = 0; i < n; i += 8) {
    _mm256_storeu_ps(out + i, apply<kOp>(_mm256_loadu_ps(a + i), _mm256_loadu_ps(b + i)));
  }
}

HEWN_TARGET int count_differing(const float* a, const float* b, std::size_t n) {
  int count = 0;
  for (std::size_t i = 0; i < n; i += 8) {
    const __m256 differ = _mm256_xor_ps(_mm256_loadu_ps(a + i), _mm256_loadu_ps(b + i));
    count += _mm_popcnt_u32(static_cast<unsigned>(_mm256_movemask_ps(differ)));
  }
  return count;
}
#undef HEWN_TARGET
constexpr FloatKernels kKernels{
    {combine<BitOp::And>, combine<BitOp::Or>, combine<BitOp::AndNot>, combine<BitOp::Not>},
    count_differing};
}  // namespace avx2

namespace avx512 {
#define HEWN_TARGET __attribute__((target("avx512f,avx512dq,popcnt")))

// The forms without a mask make gcc 12 warn about its own header (GCC bug 105593).
constexpr __mmask16 kAll = 0xffff;

template <BitOp kOp>
HEWN_TARGET inline __m512 apply(__m512 a, __m512 b) {
  const __m512 sign = _mm512_set1_ps(-0.0f);
  if constexpr (kOp == BitOp::And) return _mm512_maskz_max_ps(kAll, a, b);
  if constexpr (kOp == BitOp::Or) return _mm512_maskz_min_ps(kAll, a, b);
  if constexpr (kOp == BitOp::AndNot) return _mm512_maskz_max_ps(kAll, a, _mm512_xor_ps(b, sign));
  return _mm512_xor_ps(a, sign);
}

template <BitOp kOp>
HEWN_TARGET void combine(const float* a, const float* b, float* out, std::size_t n) {
  for (std::size_t i = 0; i < n; i += 16) {
    _mm512_storeu_ps(out + i, apply<kOp>(_mm512_loadu_ps(a + i), _mm512_loadu_ps(b + i)));
  }
}

HEWN_TARGET int count_differing(const float* a, const float* b, std::size_t n) {
  int count = 0;
  for (std::size_t i = 0; i < n; i += 16) {
    const __m512 differ = _mm512_xor_ps(_mm512_loadu_ps(a + i), _mm512_loadu_ps(b + i));
    count += _mm_popcnt_u32(_mm512_movepi32_mask(_mm512_castps_si512(differ)));
  }
  return count;
}
#undef HEWN_TARGET
constexpr FloatKernels kKernels{
    {combine<BitOp::And>, combine<BitOp::Or>, combine<BitOp::AndNot>, combine<BitOp::Not>},
    count_differing};
}  // namespace avx512
#endif

const FloatKernels& kernels_of(BitPath path) {
#ifdef HEWN_X86
  if (path == BitPath::Avx2) return avx2::kKernels;
  if (path == BitPath::Avx512) return avx512::kKernels;
#endif
  static_cast<void>(path);
  return portable::kKernels;
}

}  // namespace

int count_differing_signs(const BitProgram& program, std::span<const float* const> distances,
                          const float* wanted, std::size_t points, BitPath path) {
  const FloatKernels& kernels = kernels_of(path);
  std::vector<float> scratch(static_cast<std::size_t>(program.slots_needed()) * kFloatBlock);
  int total = 0;
  for (std::size_t begin = 0; begin < points; begin += kFloatBlock) {
    const std::size_t length = std::min(kFloatBlock, points - begin);
    const auto slot = [&](int index) {
      return scratch.data() + static_cast<std::size_t>(index) * kFloatBlock;
    };
    const auto value = [&](BitOperand operand) -> const float* {
      return operand.is_column ? distances[static_cast<std::size_t>(operand.index)] + begin
                               : slot(operand.index);
    };
    for (const BitStep& step : program.steps()) {
      kernels.combine[static_cast<std::size_t>(step.op)](value(step.a), value(step.b),
                                                         slot(step.slot), length);
    }
    total += kernels.count_differing(value(program.result()), wanted + begin, length);
  }
  return total;
}

}  // namespace hewn::bench
