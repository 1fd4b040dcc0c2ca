#pragma once
/// How the programs use the C library's allocator.
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace hewn {

/// Lets freed memory serve the next allocations instead of going back to the system at once: on
/// meshes of a million triangles, fetching pages anew took half of the time. Call it first of all.
inline void keep_freed_memory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
  mallopt(M_TOP_PAD, 64 << 20);
#endif
}

}  // namespace hewn
