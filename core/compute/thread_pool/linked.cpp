/// For builds with sanitizers, which want oneTBB from the start (core/compute/CMakeLists.txt).
#include "core/compute/thread_pool.h"

extern "C" const hewn::ThreadPool* hewn_thread_pool();

namespace hewn {

const ThreadPool& thread_pool() { return *hewn_thread_pool(); }

}  // namespace hewn
