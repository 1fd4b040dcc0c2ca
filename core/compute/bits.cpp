#include "core/compute/bits.h"

#include <algorithm>

#if defined(__x86_64__)
#include <immintrin.h>
#define HEWN_X86 1
#endif

namespace hewn {
namespace {

/// `combine(i)` yields word i of the column to count.
template <class Combine>
int count_portable(std::size_t words, const Combine& combine) {
  int total = 0;
  for (std::size_t i = 0; i < words; ++i) total += std::popcount(combine(i));
  return total;
}

namespace portable {
int count(const Word* a, std::size_t words) {
  return count_portable(words, [a](std::size_t i) { return a[i]; });
}
int count_and(const Word* a, const Word* b, std::size_t words) {
  return count_portable(words, [a, b](std::size_t i) { return a[i] & b[i]; });
}
int count_xor(const Word* a, const Word* b, std::size_t words) {
  return count_portable(words, [a, b](std::size_t i) { return a[i] ^ b[i]; });
}
void count_common_in(const Word* a, const Word* b, std::span<const Word* const> columns,
                     std::span<const std::uint32_t> blocks, std::span<CommonCounts> out) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    out[k] = {};
    for (const std::uint32_t i : blocks) {
      out[k].a += count_and(a + i, columns[k] + i, kWordBlock);
      out[k].b += count_and(b + i, columns[k] + i, kWordBlock);
    }
  }
}
constexpr BitKernels kKernels{BitPath::Portable, count, count_and, count_xor, count_common_in};
}  // namespace portable

#ifdef HEWN_X86
namespace avx2 {
#define HEWN_TARGET __attribute__((target("avx2,popcnt")))

/// Bits per byte by table look-up of nibbles (Mula, Kurz, Lemire 2018).
HEWN_TARGET inline __m256i count_bytes(__m256i v) {
  const __m256i table = _mm256_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4, 0, 1, 1, 2,
                                         1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4);
  const __m256i mask = _mm256_set1_epi8(0x0f);
  const __m256i low = _mm256_shuffle_epi8(table, _mm256_and_si256(v, mask));
  const __m256i high = _mm256_shuffle_epi8(table, _mm256_and_si256(_mm256_srli_epi32(v, 4), mask));
  return _mm256_add_epi8(low, high);
}

HEWN_TARGET inline __m256i sum_bytes(__m256i bytes) {
  return _mm256_sad_epu8(bytes, _mm256_setzero_si256());
}

/// Bits per 64-bit lane.
HEWN_TARGET inline __m256i count_lanes(__m256i v) { return sum_bytes(count_bytes(v)); }

HEWN_TARGET inline __m256i load(const Word* p) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
}

HEWN_TARGET inline int sum(__m256i v) {
  const __m128i half = _mm_add_epi64(_mm256_castsi256_si128(v), _mm256_extracti128_si256(v, 1));
  return static_cast<int>(_mm_extract_epi64(half, 0) + _mm_extract_epi64(half, 1));
}

HEWN_TARGET int count(const Word* a, std::size_t words) {
  __m256i total = _mm256_setzero_si256();
  for (std::size_t i = 0; i < words; i += 4) {
    total = _mm256_add_epi64(total, count_lanes(load(a + i)));
  }
  return sum(total);
}

HEWN_TARGET int count_and(const Word* a, const Word* b, std::size_t words) {
  __m256i total = _mm256_setzero_si256();
  for (std::size_t i = 0; i < words; i += 4) {
    total = _mm256_add_epi64(total, count_lanes(_mm256_and_si256(load(a + i), load(b + i))));
  }
  return sum(total);
}

HEWN_TARGET int count_xor(const Word* a, const Word* b, std::size_t words) {
  __m256i total = _mm256_setzero_si256();
  for (std::size_t i = 0; i < words; i += 4) {
    total = _mm256_add_epi64(total, count_lanes(_mm256_xor_si256(load(a + i), load(b + i))));
  }
  return sum(total);
}

/// Counts bits block by block, in twos: a carry-save adder halves what is looked up (Harley, Seal).
class PairCounter {
 public:
  HEWN_TARGET PairCounter() : ones_(_mm256_setzero_si256()), twos_(ones_), total_(ones_) {}

  HEWN_TARGET void add(__m256i x, __m256i y) {
    const __m256i either = _mm256_xor_si256(x, y);
    const __m256i carry = _mm256_or_si256(_mm256_and_si256(x, y), _mm256_and_si256(either, ones_));
    ones_ = _mm256_xor_si256(either, ones_);
    twos_ = _mm256_add_epi8(twos_, count_bytes(carry));
  }
  /// Due after each `kMostAdds` additions, before a byte is full.
  static constexpr std::size_t kMostAdds = 31;
  HEWN_TARGET void flush() {
    total_ = _mm256_add_epi64(total_, sum_bytes(twos_));
    twos_ = _mm256_setzero_si256();
  }
  HEWN_TARGET int sum_all() {
    flush();
    return sum(_mm256_add_epi64(_mm256_add_epi64(total_, total_), count_lanes(ones_)));
  }

 private:
  __m256i ones_;   ///< bits not counted yet
  __m256i twos_;   ///< pairs of bits, by byte
  __m256i total_;  ///< pairs of bits, by 64-bit lane
};

HEWN_TARGET void count_common_in(const Word* a, const Word* b, std::span<const Word* const> columns,
                                 std::span<const std::uint32_t> blocks,
                                 std::span<CommonCounts> out) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    PairCounter in_a;
    PairCounter in_b;
    for (std::size_t begin = 0; begin < blocks.size(); begin += PairCounter::kMostAdds) {
      const std::size_t end = std::min(blocks.size(), begin + PairCounter::kMostAdds);
      for (std::size_t j = begin; j < end; ++j) {
        const std::uint32_t i = blocks[j];
        const __m256i c0 = load(columns[k] + i);
        const __m256i c1 = load(columns[k] + i + 4);
        in_a.add(_mm256_and_si256(load(a + i), c0), _mm256_and_si256(load(a + i + 4), c1));
        in_b.add(_mm256_and_si256(load(b + i), c0), _mm256_and_si256(load(b + i + 4), c1));
      }
      in_a.flush();
      in_b.flush();
    }
    out[k] = {in_a.sum_all(), in_b.sum_all()};
  }
}
#undef HEWN_TARGET
constexpr BitKernels kKernels{BitPath::Avx2, count, count_and, count_xor, count_common_in};
}  // namespace avx2

namespace avx512 {
#define HEWN_TARGET __attribute__((target("avx512f,avx512vpopcntdq,popcnt")))

HEWN_TARGET inline __m512i load(const Word* p) { return _mm512_loadu_si512(p); }

/// Sums of lanes that are half a register apart.
HEWN_TARGET inline __m256i add_halves(__m512i v) {
  alignas(64) __m256i halves[2];
  _mm512_store_si512(halves, v);
  return _mm256_add_epi64(halves[0], halves[1]);
}

HEWN_TARGET inline int sum(__m512i v) {
  const __m256i half = add_halves(v);
  const __m128i pair =
      _mm_add_epi64(_mm256_castsi256_si128(half), _mm256_extracti128_si256(half, 1));
  return static_cast<int>(_mm_extract_epi64(pair, 0) + _mm_extract_epi64(pair, 1));
}

HEWN_TARGET int count(const Word* a, std::size_t words) {
  __m512i total = _mm512_setzero_si512();
  for (std::size_t i = 0; i < words; i += 8) {
    total = _mm512_add_epi64(total, _mm512_popcnt_epi64(load(a + i)));
  }
  return sum(total);
}

HEWN_TARGET int count_and(const Word* a, const Word* b, std::size_t words) {
  __m512i total = _mm512_setzero_si512();
  for (std::size_t i = 0; i < words; i += 8) {
    const __m512i both = _mm512_and_si512(load(a + i), load(b + i));
    total = _mm512_add_epi64(total, _mm512_popcnt_epi64(both));
  }
  return sum(total);
}

HEWN_TARGET int count_xor(const Word* a, const Word* b, std::size_t words) {
  __m512i total = _mm512_setzero_si512();
  for (std::size_t i = 0; i < words; i += 8) {
    const __m512i differ = _mm512_xor_si512(load(a + i), load(b + i));
    total = _mm512_add_epi64(total, _mm512_popcnt_epi64(differ));
  }
  return sum(total);
}

/// What one column has in common with two others, by 64-bit lane.
struct CommonLanes {
  __m512i a = {}, b = {};

  HEWN_TARGET void add(__m512i of_a, __m512i of_b, __m512i column) {
    a = _mm512_add_epi64(a, _mm512_popcnt_epi64(_mm512_and_si512(of_a, column)));
    b = _mm512_add_epi64(b, _mm512_popcnt_epi64(_mm512_and_si512(of_b, column)));
  }
  /// Either sum in its half of the lanes, as in `CommonCounts`.
  HEWN_TARGET __m256i packed() const { return add_halves(a | (b << 32)); }
};

/// Sums of neighbouring lanes: of x and y in turn.
HEWN_TARGET inline __m256i add_pairs(__m256i x, __m256i y) {
  return _mm256_add_epi64(_mm256_unpacklo_epi64(x, y), _mm256_unpackhi_epi64(x, y));
}

constexpr std::size_t kAtOnce = 4;

/// Adds up what four columns hold in common with two others; the lanes of the columns are
/// transposed to do so.
HEWN_TARGET inline void store_sums(const CommonLanes (&of)[kAtOnce], CommonCounts* out) {
  const __m256i first = add_pairs(of[0].packed(), of[1].packed());
  const __m256i second = add_pairs(of[2].packed(), of[3].packed());
  const __m256i sums = _mm256_add_epi64(_mm256_permute2x128_si256(first, second, 0x20),
                                        _mm256_permute2x128_si256(first, second, 0x31));
  static_assert(sizeof(CommonCounts) == 8 && std::endian::native == std::endian::little);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), sums);
}

HEWN_TARGET void count_common_in(const Word* a, const Word* b, std::span<const Word* const> columns,
                                 std::span<const std::uint32_t> blocks,
                                 std::span<CommonCounts> out) {
  for (std::size_t k = 0; k < columns.size(); k += kAtOnce) {
    // The last ones may be fewer: one of them then counts several times.
    const std::size_t count = std::min(kAtOnce, columns.size() - k);
    const Word* of[kAtOnce];
    for (std::size_t c = 0; c < kAtOnce; ++c) of[c] = columns[k + std::min(c, count - 1)];
    CommonLanes total[kAtOnce];
    for (const std::uint32_t i : blocks) {
      const __m512i in_a = load(a + i);
      const __m512i in_b = load(b + i);
      for (std::size_t c = 0; c < kAtOnce; ++c) total[c].add(in_a, in_b, load(of[c] + i));
    }
    CommonCounts counts[kAtOnce];
    store_sums(total, counts);
    std::copy_n(counts, count, out.data() + k);
  }
}
#undef HEWN_TARGET
constexpr BitKernels kKernels{BitPath::Avx512, count, count_and, count_xor, count_common_in};
}  // namespace avx512
#endif

bool has_path(BitPath path) {
#ifdef HEWN_X86
  if (path == BitPath::Avx2) return __builtin_cpu_supports("avx2");
  if (path == BitPath::Avx512) {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vpopcntdq");
  }
#endif
  return path == BitPath::Portable;
}

const BitKernels& choose() {
#ifdef HEWN_X86
  if (has_path(BitPath::Avx512)) return avx512::kKernels;
  if (has_path(BitPath::Avx2)) return avx2::kKernels;
#endif
  return portable::kKernels;
}

}  // namespace

const BitKernels& bit_kernels() {
  static const BitKernels& chosen = choose();
  return chosen;
}

const BitKernels* bit_kernels(BitPath path) {
  if (!has_path(path)) return nullptr;
#ifdef HEWN_X86
  if (path == BitPath::Avx2) return &avx2::kKernels;
  if (path == BitPath::Avx512) return &avx512::kKernels;
#endif
  return &portable::kKernels;
}

}  // namespace hewn
