#pragma once
/// What kernels need to be one source for two compilers. The only header that asks which compiler
/// reads it.
#include <cstdint>

#include "core/compute/bits.h"

#if defined(__CUDACC__)
#define HEWN_HD __host__ __device__ __forceinline__
#else
#define HEWN_HD inline __attribute__((always_inline))
#endif

namespace hewn {

/// How much of a problem one item of a kernel covers. Many small items suit a device, few large
/// ones a processor core with vector units.
struct HostGrain {
  static constexpr int kRows = 64;    ///< rows of a bit column: one word
  static constexpr int kWords = 128;  ///< words that a tree is evaluated on at a time
  static constexpr int kBlock = 8;    ///< words in a row that vector units take; divides `kWords`
  static constexpr int kGroup = 1;    ///< items that work in step
};
struct DeviceGrain {
  static constexpr int kRows = 1;
  static constexpr int kWords = 2;
  static constexpr int kBlock = 2;
  static constexpr int kGroup = 32;  ///< a warp
};

HEWN_HD int count_bits(Word word) {
#if defined(__CUDA_ARCH__)
  return __popcll(word);
#else
  return __builtin_popcountll(word);
#endif
}

/// *target += value. Sums of integers come out the same in any order.
HEWN_HD void sum_into(int* target, int value) {
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ >= 800
  // One atomic operation for all threads of the warp that add to the same place.
  const unsigned peers =
      __match_any_sync(__activemask(), reinterpret_cast<unsigned long long>(target));
  const int total = __reduce_add_sync(peers, value);
  const unsigned lane = threadIdx.x & 31u;
  if (lane == static_cast<unsigned>(__ffs(static_cast<int>(peers)) - 1)) atomicAdd(target, total);
#elif defined(__CUDA_ARCH__)
  atomicAdd(target, value);
#else
  __atomic_fetch_add(target, value, __ATOMIC_RELAXED);
#endif
}

/// *target |= bits
HEWN_HD void unite_into(Word* target, Word bits) {
#if defined(__CUDA_ARCH__)
  // Most threads find their bits set already, and reading costs less.
  auto* place = reinterpret_cast<unsigned long long*>(target);
  const unsigned long long known = *static_cast<volatile unsigned long long*>(place);
  if ((bits & ~known) != 0) atomicOr(place, static_cast<unsigned long long>(bits));
#else
  if ((bits & ~__atomic_load_n(target, __ATOMIC_RELAXED)) != 0) {
    __atomic_fetch_or(target, bits, __ATOMIC_RELAXED);
  }
#endif
}

/// Stores `value` in a place that holds `expected`, as one step; returns what was there before.
HEWN_HD int exchange_if(int* target, int expected, int value) {
#if defined(__CUDA_ARCH__)
  return atomicCAS(target, expected, value);
#else
  __atomic_compare_exchange_n(target, &expected, value, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
  return expected;
#endif
}

/// Puts `kRows` bits of a column in place: one thread stores a whole word, or 32 threads with
/// successive rows join theirs. Requires, for `kRows` == 1: all threads of the warp call it, for
/// rows of one word's half; `row` is a multiple of `kRows`.
template <int kRows>
HEWN_HD void store_rows(Word* column, std::int64_t row, Word bits) {
#if defined(__CUDA_ARCH__)
  static_assert(kRows == 1, "a thread of a device has one row");
  const unsigned half = __ballot_sync(0xffffffffu, bits != 0);
  if ((row & 31) == 0) reinterpret_cast<unsigned*>(column)[row >> 5] = half;
#else
  static_assert(kRows == 64, "a thread of the host has a word of rows");
  column[row >> 6] = bits;
#endif
}

}  // namespace hewn
