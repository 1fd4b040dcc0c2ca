#pragma once
/// How the programs use the C library's heap.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define HEWN_TUNES_HEAP
#include <cstdint>
#include <cstdlib>

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace hewn {

/// For work on meshes: has the heap take pages of two megabytes beyond its first eight: reading a
/// mesh of a million triangles took a quarter less time, while a small job has no use for them.
/// Half of the memory is set aside for it, which costs nothing until it is used. Without such
/// pages, or where the process may only have so much, the heap works as before. Call it after
/// `keep_freed_memory`, which keeps what is set aside.
inline void use_large_pages() {
#if defined(HEWN_TUNES_HEAP)
  constexpr std::size_t kPage = std::size_t{2} << 20;
  constexpr std::size_t kSmall = 4 * kPage;
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit = {};
    if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY) return;
  }
  const std::size_t memory = static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) *
                             static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  void* const aside = memory / 2 > 2 * kSmall ? std::malloc(memory / 2) : nullptr;
  if (aside == nullptr) return;
  char* begin = static_cast<char*>(aside) + kSmall;
  begin += kPage - reinterpret_cast<std::uintptr_t>(begin) % kPage;
  static_cast<void>(::madvise(begin, memory / 2 - kSmall - 2 * kPage, MADV_HUGEPAGE));
  std::free(aside);
#endif
}

/// Fetches the pages that even a small job writes to all at once, which costs a tenth of fetching
/// them one by one: of optimising a small tree, one part in thirty. Call it after
/// `keep_freed_memory`.
inline void fetch_first_pages() {
#if defined(HEWN_TUNES_HEAP) && defined(MADV_POPULATE_WRITE)
  constexpr std::size_t kPage = 4096;
  constexpr std::size_t kFetched = 80 * kPage;
  void* const first = std::malloc(kFetched + kPage);
  if (first == nullptr) return;
  char* begin = static_cast<char*>(first) + kPage - 1;
  begin -= reinterpret_cast<std::uintptr_t>(begin) % kPage;
  static_cast<void>(::madvise(begin, kFetched, MADV_POPULATE_WRITE));
  std::free(first);
#endif
}

/// Lets freed memory serve the next allocations instead of going back to the system: on meshes of
/// a million triangles, fetching pages anew took half of the time. Call it first of all.
inline void keep_freed_memory() {
#if defined(HEWN_TUNES_HEAP)
  constexpr int kNever = -1;
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, kNever);
  mallopt(M_TOP_PAD, 64 << 20);
#endif
}

}  // namespace hewn
