#pragma once
/// The threads that loops share, behind a library that is loaded when the first loop is long enough
/// for them: binding oneTBB takes a tenth of what a small command takes. Included by the loops
/// alone.
#include <cstddef>
#include <functional>

namespace hewn {

struct ThreadPool {
  /// As `for_each_chunk`, over [begin, end).
  void (*for_each_range)(int threads, std::size_t begin, std::size_t end, std::size_t grain,
                         const std::function<void(std::size_t, std::size_t)>& body);
  /// Calls `loop`; while this thread waits for others there, it begins nothing else.
  void (*isolate)(int threads, const std::function<void()>& loop);
};

/// The library's file; it lies beside the program.
inline constexpr const char* kThreadsLibrary = "libhewn-threads.so";
/// Its one symbol: a `const ThreadPool* ()`.
inline constexpr const char* kThreadsSymbol = "hewn_thread_pool";

/// Loads the library, which stays loaded. Throws std::runtime_error when it cannot be.
const ThreadPool& thread_pool();

}  // namespace hewn
