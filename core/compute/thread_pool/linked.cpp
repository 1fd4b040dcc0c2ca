/// For builds where the leak checker, or a machine with little else, wants oneTBB from the start.
#include "core/compute/thread_pool.h"

extern "C" const hewn::ThreadPool* hewn_thread_pool();

namespace hewn {

const ThreadPool& thread_pool() { return *hewn_thread_pool(); }

}  // namespace hewn
