#pragma once
/// Checks for bugs (never for bad input): on in Debug and sanitizer builds, off otherwise.
#include <cstdio>
#include <cstdlib>

#if !defined(NDEBUG) || defined(HEWN_ASSERTIONS)
#define HEWN_ASSERT(condition, why)                                                              \
  do {                                                                                           \
    if (!(condition)) {                                                                          \
      std::fprintf(stderr, "%s:%d: assertion failed: %s (%s)\n", __FILE__, __LINE__, #condition, \
                   why);                                                                         \
      std::abort();                                                                              \
    }                                                                                            \
  } while (false)
#else
#define HEWN_ASSERT(condition, why) static_cast<void>(0)
#endif
