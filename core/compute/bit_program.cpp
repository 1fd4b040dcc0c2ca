#include "core/compute/bit_program.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/assert.h"

#if defined(__x86_64__)
#include <immintrin.h>
#define HEWN_X86 1
#endif

namespace hewn {
namespace {

/// Applies one operation to blocks; `words` is a multiple of `kWordBlock`. `out` may be `a` or `b`.
using Combine = void (*)(const Word* a, const Word* b, Word* out, std::size_t words);
/// Indexed by `BitOp`.
using Combines = std::array<Combine, 4>;

namespace portable {
template <BitOp kOp>
void combine(const Word* a, const Word* b, Word* out, std::size_t words) {
  for (std::size_t i = 0; i < words; ++i) {
    if constexpr (kOp == BitOp::And) out[i] = a[i] & b[i];
    if constexpr (kOp == BitOp::Or) out[i] = a[i] | b[i];
    if constexpr (kOp == BitOp::AndNot) out[i] = a[i] & ~b[i];
    if constexpr (kOp == BitOp::Not) out[i] = ~a[i];
  }
}
constexpr Combines kCombines{combine<BitOp::And>, combine<BitOp::Or>, combine<BitOp::AndNot>,
                             combine<BitOp::Not>};
}  // namespace portable

#ifdef HEWN_X86
// The compiler would have to fear that `out` overlaps `a` or `b`; intrinsics need not.
namespace avx2 {
#define HEWN_TARGET __attribute__((target("avx2")))

template <BitOp kOp>
HEWN_TARGET inline __m256i apply(__m256i a, __m256i b) {
  if constexpr (kOp == BitOp::And) return _mm256_and_si256(a, b);
  if constexpr (kOp == BitOp::Or) return _mm256_or_si256(a, b);
  if constexpr (kOp == BitOp::AndNot) return _mm256_andnot_si256(b, a);
  return _mm256_xor_si256(a, _mm256_set1_epi64x(-1));
}

template <BitOp kOp>
HEWN_TARGET void combine(const Word* a, const Word* b, Word* out, std::size_t words) {
  for (std::size_t i = 0; i < words; i += 4) {
    const __m256i x = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(a + i));
    const __m256i y = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(b + i));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + i), apply<kOp>(x, y));
  }
}
#undef HEWN_TARGET
constexpr Combines kCombines{combine<BitOp::And>, combine<BitOp::Or>, combine<BitOp::AndNot>,
                             combine<BitOp::Not>};
}  // namespace avx2

namespace avx512 {
#define HEWN_TARGET __attribute__((target("avx512f")))

template <BitOp kOp>
HEWN_TARGET inline __m512i apply(__m512i a, __m512i b) {
  if constexpr (kOp == BitOp::And) return _mm512_and_si512(a, b);
  if constexpr (kOp == BitOp::Or) return _mm512_or_si512(a, b);
  // Not _mm512_andnot_si512: gcc 12 warns about its header (GCC bug 105593).
  if constexpr (kOp == BitOp::AndNot) return _mm512_and_si512(a, _mm512_xor_si512(a, b));
  return _mm512_xor_si512(a, _mm512_set1_epi64(-1));
}

template <BitOp kOp>
HEWN_TARGET void combine(const Word* a, const Word* b, Word* out, std::size_t words) {
  for (std::size_t i = 0; i < words; i += 8) {
    const __m512i x = _mm512_loadu_si512(a + i);
    const __m512i y = _mm512_loadu_si512(b + i);
    _mm512_storeu_si512(out + i, apply<kOp>(x, y));
  }
}
#undef HEWN_TARGET
constexpr Combines kCombines{combine<BitOp::And>, combine<BitOp::Or>, combine<BitOp::AndNot>,
                             combine<BitOp::Not>};
}  // namespace avx512
#endif

const Combines& combines_of(BitPath path) {
#ifdef HEWN_X86
  if (path == BitPath::Avx2) return avx2::kCombines;
  if (path == BitPath::Avx512) return avx512::kCombines;
#endif
  static_cast<void>(path);
  return portable::kCombines;
}

bool applied(BitOp op, bool a, bool b) {
  switch (op) {
    case BitOp::And:
      return a && b;
    case BitOp::Or:
      return a || b;
    case BitOp::AndNot:
      return a && !b;
    case BitOp::Not:
      return !a;
  }
  return false;
}

/// Room for intermediate results: on the stack for all but freak formulas.
class Scratch {
 public:
  explicit Scratch(int slots) {
    if (slots <= kInlineSlots) return;
    heap_.resize(static_cast<std::size_t>(slots) * BitProgram::kBlockWords);
    data_ = heap_.data();
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  Word* slot(int index) {
    return data_ + static_cast<std::size_t>(index) * BitProgram::kBlockWords;
  }

 private:
  static constexpr int kInlineSlots = 16;
  // Not cleared: every slot is written before it is read.
  alignas(64) std::array<Word, kInlineSlots * BitProgram::kBlockWords> inline_;
  std::vector<Word> heap_;
  Word* data_ = inline_.data();
};

}  // namespace

void BitProgram::push_column(int column) {
  HEWN_ASSERT(column >= 0, "columns are counted from 0");
  stack_.push_back({{true, column}, false});
  columns_needed_ = std::max(columns_needed_, column + 1);
}

void BitProgram::push_op(BitOp op) {
  const bool is_unary = op == BitOp::Not;
  HEWN_ASSERT(stack_.size() >= (is_unary ? 1u : 2u), "an operation needs its operands");
  const Value b = stack_.back();
  stack_.pop_back();
  Value a = b;
  if (!is_unary) {
    a = stack_.back();
    stack_.pop_back();
  }
  const int slot = free_slot();
  steps_.push_back({op, a.operand, b.operand, slot});
  slots_needed_ = std::max(slots_needed_, slot + 1);
  stack_.push_back({{false, slot}, applied(op, a.of_zeros, b.of_zeros)});
}

int BitProgram::free_slot() const {
  // Slots are taken and released in the order of the stack, so the topmost one tells.
  const auto topmost = std::find_if(stack_.rbegin(), stack_.rend(),
                                    [](const auto& v) { return !v.operand.is_column; });
  return topmost == stack_.rend() ? 0 : topmost->operand.index + 1;
}

int BitProgram::count_differing(std::span<const Word* const> columns, const Word* wanted,
                                std::size_t bits) const {
  return count_differing(columns, wanted, bits, bit_kernels().path);
}

int BitProgram::count_differing(std::span<const Word* const> columns, const Word* wanted,
                                std::size_t bits, BitPath path) const {
  HEWN_ASSERT(is_complete(), "an incomplete formula has no value");
  HEWN_ASSERT(columns.size() >= static_cast<std::size_t>(columns_needed_), "a column is missing");
  const Combines& combines = combines_of(path);
  const auto count_xor = bit_kernels(path)->count_xor;
  const std::size_t words = padded_words(bits);
  Scratch scratch(slots_needed_);
  int total = 0;
  for (std::size_t begin = 0; begin < words; begin += kBlockWords) {
    const std::size_t length = std::min(kBlockWords, words - begin);
    const auto value = [&](BitOperand operand) -> const Word* {
      return operand.is_column ? columns[static_cast<std::size_t>(operand.index)] + begin
                               : scratch.slot(operand.index);
    };
    for (const BitStep& step : steps_) {
      combines[static_cast<std::size_t>(step.op)](value(step.a), value(step.b),
                                                  scratch.slot(step.slot), length);
    }
    total += count_xor(value(result()), wanted + begin, length);
  }
  // A formula that is true where all columns are zero differs from the padding's zeros, too.
  const std::size_t padding = words * 64 - bits;
  return stack_.back().of_zeros ? total - static_cast<int>(padding) : total;
}

}  // namespace hewn
