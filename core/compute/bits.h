#pragma once
/// Word-parallel logic on bit columns. AVX2 and AVX-512 are chosen at run time; every path gives
/// the same integers.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hewn {

using Word = std::uint64_t;

/// Columns are padded with zero words to a multiple of this, so that kernels need no tails.
inline constexpr std::size_t kWordBlock = 8;

/// Words needed for `bits` bits, padded.
constexpr std::size_t padded_words(std::size_t bits) {
  const std::size_t block_bits = 64 * kWordBlock;
  return (bits + block_bits - 1) / block_bits * kWordBlock;
}

enum class BitPath { Portable, Avx2, Avx512 };

/// How many bits two columns have in common with a third.
struct CommonCounts {
  int a = 0, b = 0;
};

/// The counting kernels of one instruction set. All lengths are in words and multiples of
/// `kWordBlock`.
struct BitKernels {
  BitPath path;
  int (*count)(const Word* a, std::size_t words);
  int (*count_and)(const Word* a, const Word* b, std::size_t words);
  /// Bits where `a` and `b` differ.
  int (*count_xor)(const Word* a, const Word* b, std::size_t words);
  /// For every column: the bits of `a & column` and of `b & column` in some of the blocks; `blocks`
  /// are the indices of their first words.
  /// Requires: `out.size() == columns.size()`. Cost: O(columns x blocks).
  void (*count_common_in)(const Word* a, const Word* b, std::span<const Word* const> columns,
                          std::span<const std::uint32_t> blocks, std::span<CommonCounts> out);
};

/// The fastest path that this processor has.
const BitKernels& bit_kernels();

/// A given path, for tests and benchmarks; nullptr when the processor lacks it.
const BitKernels* bit_kernels(BitPath path);

inline bool test_bit(const Word* words, std::size_t i) { return (words[i >> 6] >> (i & 63)) & 1; }
inline void set_bit(Word* words, std::size_t i) { words[i >> 6] |= Word{1} << (i & 63); }

/// Calls `visit(i)` for every set bit in ascending order.
template <class Visit>
void for_each_bit(std::span<const Word> words, const Visit& visit) {
  for (std::size_t w = 0; w < words.size(); ++w) {
    for (Word rest = words[w]; rest != 0; rest &= rest - 1) {
      visit(w * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
    }
  }
}

/// An order-dependent 64-bit mix of the words, for duplicate detection.
inline std::uint64_t hash_words(std::span<const Word> words, std::uint64_t seed = 0) {
  std::uint64_t h = seed ^ 1469598103934665603ull;
  for (const Word w : words) {
    h ^= w;
    h *= 0x9E3779B97F4A7C15ull;
    h ^= h >> 31;
  }
  return h;
}

}  // namespace hewn
