#include "core/synth/evolve/fitness.h"

#include <algorithm>

#if defined(__x86_64__)
#include <immintrin.h>
#define HEWN_X86 1
#endif

namespace hewn {
namespace {

/// left = left op right; whether both had a row in common. `words` is a multiple of `kWordBlock`.
using Join = bool (*)(const Word* left, const Word* right, Word* out, std::size_t words);

struct Joins {
  Join unite, intersect, subtract;
};

namespace portable {
template <Token kOp>
bool join(const Word* left, const Word* right, Word* out, std::size_t words) {
  Word common = 0;
  for (std::size_t i = 0; i < words; ++i) {
    const Word both = left[i] & right[i];
    common |= both;
    out[i] = kOp == kUnionToken          ? left[i] | right[i]
             : kOp == kIntersectionToken ? both
                                         : left[i] & ~right[i];
  }
  return common != 0;
}
constexpr Joins kJoins{join<kUnionToken>, join<kIntersectionToken>, join<kDifferenceToken>};
}  // namespace portable

#ifdef HEWN_X86
namespace avx2 {
template <Token kOp>
__attribute__((target("avx2"))) bool join(const Word* left, const Word* right, Word* out,
                                          std::size_t words) {
  __m256i common = _mm256_setzero_si256();
  for (std::size_t i = 0; i < words; i += 4) {
    const __m256i a = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(left + i));
    const __m256i b = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(right + i));
    const __m256i both = _mm256_and_si256(a, b);
    common = _mm256_or_si256(common, both);
    __m256i result = both;
    if constexpr (kOp == kUnionToken) result = _mm256_or_si256(a, b);
    if constexpr (kOp == kDifferenceToken) result = _mm256_andnot_si256(b, a);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + i), result);
  }
  return _mm256_testz_si256(common, common) == 0;
}
constexpr Joins kJoins{join<kUnionToken>, join<kIntersectionToken>, join<kDifferenceToken>};
}  // namespace avx2
#endif

const Joins& joins() {
#ifdef HEWN_X86
  if (bit_kernels().path != BitPath::Portable) return avx2::kJoins;
#endif
  return portable::kJoins;
}

}  // namespace

FitnessTable::FitnessTable(const CellColumns& cells, const Column& wanted, const Column& care) {
  std::vector<std::size_t> rows;
  for_each_bit(care, [&](std::size_t c) { rows.push_back(c); });
  words_ = padded_words(rows.size());
  const auto packed = [&](const Column& from) {
    Column out(words_, 0);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (test_bit(from.data(), rows[r])) set_bit(out.data(), r);
    }
    return out;
  };
  for (int k = 0; k < cells.literals(); ++k) columns_.push_back(packed(cells.column(k)));
  wanted_ = packed(wanted);
  all_ = packed(care);
  inside_ = bit_kernels().count(wanted_.data(), words_);
  outside_ = static_cast<int>(rows.size()) - inside_;
}

Measures FitnessTable::measure(const Genome& genome, FitnessScratch& scratch) const {
  const Joins& join = joins();
  // Operands are read where they are: in a column, or in the slot of their depth on the stack.
  const std::size_t deepest = genome.size() / 2 + 2;
  if (scratch.slots.size() < deepest * words_) scratch.slots.resize(deepest * words_);
  std::vector<const Word*>& stack = scratch.stack;
  stack.clear();
  Measures m;
  m.size = static_cast<int>(genome.size());
  for (const Token t : genome) {
    if (t >= 0) {
      stack.push_back(columns_[static_cast<std::size_t>(t)].data());
      ++m.proximity;
      continue;
    }
    if (t == kComplementToken) {
      Word* out = scratch.slots.data() + (stack.size() - 1) * words_;
      join.subtract(all_.data(), stack.back(), out, words_);
      stack.back() = out;
      ++m.proximity;
      continue;
    }
    const Word* right = stack.back();
    stack.pop_back();
    Word* out = scratch.slots.data() + (stack.size() - 1) * words_;
    const Join apply = t == kUnionToken          ? join.unite
                       : t == kIntersectionToken ? join.intersect
                                                 : join.subtract;
    m.proximity += apply(stack.back(), right, out, words_) ? 1 : 0;
    stack.back() = out;
  }
  const int held = bit_kernels().count(stack.back(), words_);
  m.inside_right = bit_kernels().count_and(stack.back(), wanted_.data(), words_);
  m.outside_right = outside_ - (held - m.inside_right);
  return m;
}

}  // namespace hewn
