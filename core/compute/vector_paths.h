#pragma once
/// The same body compiled for every instruction set of the processor. Included by those who run
/// kernels.
#include "core/compute/bits.h"

namespace hewn {

#if defined(__x86_64__)
template <class Body>
__attribute__((target("avx2,popcnt"))) void call_for_avx2(const Body& body) {
  body();
}
template <class Body>
__attribute__((target("avx512f,avx512dq,avx512vpopcntdq,popcnt"))) void call_for_avx512(
    const Body& body) {
  body();
}
#endif

/// Calls `body()` with the instructions of `path`. Its operator and all that it calls should be
/// `HEWN_HD`, so that they are inlined here.
template <class Body>
void call_on_path(BitPath path, const Body& body) {
#if defined(__x86_64__)
  if (path == BitPath::Avx2) return call_for_avx2(body);
  if (path == BitPath::Avx512) return call_for_avx512(body);
#endif
  static_cast<void>(path);
  body();
}

}  // namespace hewn
