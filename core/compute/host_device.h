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
  static constexpr int kRows = 64;     ///< rows of a bit column: one word
  static constexpr int kWords = 128;   ///< words that a tree is evaluated on at a time
  static constexpr int kBlock = 8;     ///< words in a row that vector units take; divides `kWords`
  static constexpr int kSamples = 64;  ///< samples of a surface that a tree is scored at
  static constexpr int kGroup = 1;     ///< items that work in step
};
struct DeviceGrain {
  static constexpr int kRows = 1;
  static constexpr int kWords = 2;
  static constexpr int kBlock = 2;
  static constexpr int kSamples = 4;
  static constexpr int kGroup = 32;  ///< a warp
};
/// For kernels that spend more on each item than on its words, where there are words enough.
struct WideDeviceGrain : DeviceGrain {
  static constexpr int kWords = 4;
  static constexpr int kBlock = 4;
};

HEWN_HD int count_bits(Word word) {
#if defined(__CUDA_ARCH__)
  return __popcll(word);
#else
  return __builtin_popcountll(word);
#endif
}

/// a / b. Requires: 0 <= a, 0 < b. GPUs divide 64-bit numbers slowly.
HEWN_HD std::int64_t quotient(std::int64_t a, std::int64_t b) {
#if defined(__CUDA_ARCH__)
  if (((a | b) >> 32) == 0) return static_cast<unsigned>(a) / static_cast<unsigned>(b);
#endif
  return a / b;
}

/// a * b. GPUs multiply 64-bit numbers slowly.
HEWN_HD std::int64_t wide_product(std::int32_t a, std::int32_t b) {
#if defined(__CUDA_ARCH__)
  long long product;
  asm("mul.wide.s32 %0, %1, %2;" : "=l"(product) : "r"(a), "r"(b));
  return product;
#else
  return static_cast<std::int64_t>(a) * b;
#endif
}

/// *from, in one step. Requires: 8 bytes, aligned to their size.
template <class T>
HEWN_HD T load(const T* from) {
#if defined(__CUDA_ARCH__)
  static_assert(sizeof(T) == sizeof(unsigned long long) && alignof(T) == sizeof(T));
  const unsigned long long bytes = *reinterpret_cast<const unsigned long long*>(from);
  T value;
  memcpy(&value, &bytes, sizeof(T));
  return value;
#else
  return *from;
#endif
}

#if defined(__CUDA_ARCH__)
/// Whether the calling thread is the first of those in `mask`, a part of its warp.
HEWN_HD bool is_first_of(unsigned mask) {
  return (threadIdx.x & 31u) == static_cast<unsigned>(__ffs(static_cast<int>(mask)) - 1);
}
#endif

/// *target += value, in one step for a warp. Sums of integers come out the same in any order.
/// Requires: threads that run it together have the same target.
HEWN_HD void sum_into(int* target, int value) {
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ >= 800
  const unsigned peers = __activemask();
  const int total = __reduce_add_sync(peers, value);
  if (is_first_of(peers)) atomicAdd(target, total);
#elif defined(__CUDA_ARCH__)
  atomicAdd(target, value);
#else
  __atomic_fetch_add(target, value, __ATOMIC_RELAXED);
#endif
}

/// The same for large sums of small numbers. Requires: a warp's values add up to less than 2^32.
HEWN_HD void sum_into(std::uint64_t* target, std::uint32_t value) {
#if defined(__CUDA_ARCH__)
  auto* place = reinterpret_cast<unsigned long long*>(target);
#if __CUDA_ARCH__ >= 800
  const unsigned peers = __activemask();
  const unsigned total = __reduce_add_sync(peers, value);
  if (is_first_of(peers)) atomicAdd(place, static_cast<unsigned long long>(total));
#else
  atomicAdd(place, static_cast<unsigned long long>(value));
#endif
#else
  __atomic_fetch_add(target, value, __ATOMIC_RELAXED);
#endif
}

/// *target += value; any threads, any targets.
HEWN_HD void add_to(int* target, int value) {
#if defined(__CUDA_ARCH__)
  atomicAdd(target, value);
#else
  __atomic_fetch_add(target, value, __ATOMIC_RELAXED);
#endif
}

/// *flag = 1
HEWN_HD void set_flag(int* flag) {
#if defined(__CUDA_ARCH__)
  *static_cast<volatile int*>(flag) = 1;
#else
  __atomic_store_n(flag, 1, __ATOMIC_RELAXED);
#endif
}

/// *target |= bits, with the same requirement as `sum_into`.
HEWN_HD void unite_into(Word* target, Word bits) {
#if defined(__CUDA_ARCH__)
#if __CUDA_ARCH__ >= 800
  const unsigned peers = __activemask();
  const unsigned low = __reduce_or_sync(peers, static_cast<unsigned>(bits));
  const unsigned high = __reduce_or_sync(peers, static_cast<unsigned>(bits >> 32));
  if (!is_first_of(peers)) return;
  bits = static_cast<Word>(high) << 32 | low;
#endif
  // Most find their bits set already, and reading costs less.
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

/// Copies `kWords` words between places aligned to their size: on a device, two at a time.
template <int kWords>
HEWN_HD void copy_words(Word* to, const Word* from) {
#if defined(__CUDA_ARCH__)
  static_assert(kWords % 2 == 0, "devices move 16 bytes at a time");
  for (int i = 0; i < kWords; i += 2) {
    *reinterpret_cast<ulonglong2*>(to + i) = *reinterpret_cast<const ulonglong2*>(from + i);
  }
#else
  for (int i = 0; i < kWords; ++i) to[i] = from[i];
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
