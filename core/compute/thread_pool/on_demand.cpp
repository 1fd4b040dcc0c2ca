#include <stdexcept>
#include <string>

#include "core/base/module.h"
#include "core/compute/thread_pool.h"

namespace hewn {
namespace {

const ThreadPool* load() {
  const auto pool = module_functions<ThreadPool>(kThreadsLibrary, kThreadsSymbol);
  if (pool) return *pool;
  throw std::runtime_error(
      "more than one thread needs a part of the program that cannot be loaded (" +
      pool.error().message + "); keep " + kThreadsLibrary +
      " beside the program, or use one thread");
}

}  // namespace

const ThreadPool& thread_pool() {
  static const ThreadPool* const pool = load();
  return *pool;
}

}  // namespace hewn
