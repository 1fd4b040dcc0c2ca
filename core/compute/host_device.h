#pragma once
/// What kernels need to be one source for two compilers.
#include <cstdint>
#include <cstring>

#include "core/base/host_device_function.h"
#include "core/compute/bits.h"

namespace hewn {

/// How much of a problem one item of a kernel covers. Many small items suit a device, few large
/// ones a processor core with vector units.
struct HostGrain {
  static constexpr int kRows = 64;     ///< rows of a bit column: one word
  static constexpr int kWords = 128;   ///< words that a tree is evaluated on at a time
  static constexpr int kBlock = 8;     ///< words in a row that vector units take; divides `kWords`
  static constexpr int kSamples = 64;  ///< samples of a surface that a tree is scored at
  static constexpr int kFitLanes = 8;  ///< of the lanes that take turns at a fit's data
  static constexpr int kGroup = 1;     ///< items that work in step
};
struct DeviceGrain {
  static constexpr int kRows = 1;
  static constexpr int kWords = 2;
  static constexpr int kBlock = 2;
  static constexpr int kSamples = 8;
  static constexpr int kFitLanes = 1;
  static constexpr int kGroup = 32;  ///< a warp
};
/// For kernels that spend more on each item than on its words, where there are words enough.
struct WideDeviceGrain : DeviceGrain {
  static constexpr int kWords = 4;
  static constexpr int kBlock = 4;
};
/// The same with two groups to a warp.
struct PairedDeviceGrain : WideDeviceGrain {
  static constexpr int kGroup = 16;
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

/// `from` moved on by `index` times `stride` bytes, in one operation of a GPU.
template <class T>
HEWN_HD const T* offset_by(const T* from, std::int32_t index, std::int32_t stride) {
#if defined(__CUDA_ARCH__)
  const T* moved;
  asm("mad.wide.s32 %0, %1, %2, %3;" : "=l"(moved) : "r"(index), "r"(stride), "l"(from));
  return moved;
#else
  return reinterpret_cast<const T*>(reinterpret_cast<const char*>(from) +
                                    static_cast<std::int64_t>(index) * stride);
#endif
}

/// *from as a T, in one step. Requires: 8 bytes, aligned to their size.
template <class T, class U>
HEWN_HD T load(const U* from) {
  static_assert(sizeof(T) == 8 && sizeof(U) == 8 && alignof(U) == 8);
  T value;
#if defined(__CUDA_ARCH__)
  const uint2 bytes = *reinterpret_cast<const uint2*>(from);
  memcpy(&value, &bytes, sizeof(T));
#else
  memcpy(&value, from, sizeof(T));
#endif
  return value;
}

#if defined(__CUDA_ARCH__)
/// The threads of the warp that are here with the same address.
HEWN_HD unsigned peers_of(const void* address) {
  return __match_any_sync(__activemask(), reinterpret_cast<unsigned long long>(address));
}
/// Whether the calling thread is the first of those in `mask`, a part of its warp.
HEWN_HD bool is_first_of(unsigned mask) {
  return (threadIdx.x & 31u) == static_cast<unsigned>(__ffs(static_cast<int>(mask)) - 1);
}
#endif

/// *target += value, in one step for threads of a warp with the same target. Sums of integers come
/// out the same in any order.
HEWN_HD void sum_into(int* target, int value) {
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ >= 800
  const unsigned peers = peers_of(target);
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
  const unsigned peers = peers_of(target);
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

/// *target |= bits, in one step for threads of a warp with the same target.
HEWN_HD void unite_into(std::uint32_t* target, std::uint32_t bits) {
#if defined(__CUDA_ARCH__)
#if __CUDA_ARCH__ >= 800
  const unsigned peers = peers_of(target);
  bits = __reduce_or_sync(peers, bits);
  if (!is_first_of(peers)) return;
#endif
  // Most find their bits set already, and reading costs less.
  if ((bits & ~*static_cast<volatile std::uint32_t*>(target)) != 0) atomicOr(target, bits);
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
  // Most find another value, and to read it leaves the place in other cores' caches.
  if (const int known = __atomic_load_n(target, __ATOMIC_RELAXED); known != expected) return known;
  __atomic_compare_exchange_n(target, &expected, value, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
  return expected;
#endif
}

/// Words that a device moves at a time.
inline constexpr int kMovedWords = 2;

/// Copies `kWords` words, two at a time, which lie `kFromGap` words apart at `from`. Requires, on a
/// device: places aligned to 16 bytes.
template <int kWords, int kFromGap = kMovedWords>
HEWN_HD void copy_words(Word* to, const Word* from) {
  static_assert(kWords % kMovedWords == 0);
  for (int i = 0; i < kWords / kMovedWords; ++i, to += kMovedWords, from += kFromGap) {
#if defined(__CUDA_ARCH__)
    *reinterpret_cast<ulonglong2*>(to) = *reinterpret_cast<const ulonglong2*>(from);
#else
    to[0] = from[0];
    to[1] = from[1];
#endif
  }
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
