#include "core/compute/cpu_device.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <type_traits>

#include "core/compute/kernels/kernels.h"
#include "core/compute/parallel.h"
#include "core/compute/vector_paths.h"

namespace hewn {
namespace {

constexpr std::size_t kAlignment = 64;
/// Chunks a thread gets on average, so that none waits long for the last one.
constexpr std::int64_t kChunksPerThread = 16;
constexpr std::int64_t kAssumedThreads = 16;

/// Some of a kernel's items.
template <class K>
struct Items {
  const K& kernel;
  std::int64_t begin, end;

  HEWN_HD void operator()() const {
    for (std::int64_t i = begin; i < end; ++i) kernel.template run<HostGrain>(i);
  }
};

}  // namespace

CpuDevice::CpuDevice(int threads, std::size_t memory_budget, BitPath path)
    : info_{"processor", false, memory_budget}, threads_(threads), path_(path) {}

Result<void*> CpuDevice::allocate(std::size_t bytes) {
  return ::operator new (bytes, std::align_val_t{kAlignment});
}

void CpuDevice::release(void* memory) { ::operator delete (memory, std::align_val_t{kAlignment}); }

Result<void> CpuDevice::upload(void* to, const void* from, std::size_t bytes) {
  std::memcpy(to, from, bytes);
  return {};
}

Result<void> CpuDevice::download(void* to, const void* from, std::size_t bytes) {
  std::memcpy(to, from, bytes);
  return {};
}

Result<void> CpuDevice::fill(void* to, unsigned char byte, std::size_t bytes) {
  std::memset(to, byte, bytes);
  return {};
}

Result<void> CpuDevice::launch(const Kernel& kernel) {
  std::visit(
      [this](const auto& k) {
        const std::int64_t items = k.template items<HostGrain>();
        const std::int64_t grain =
            std::max<std::int64_t>(1, items / (kAssumedThreads * kChunksPerThread));
        for_each_chunk(threads_, static_cast<std::size_t>(items), static_cast<std::size_t>(grain),
                       [this, &k](std::size_t begin, std::size_t end) {
                         call_on_path(path_, Items<std::decay_t<decltype(k)>>{
                                                 k, static_cast<std::int64_t>(begin),
                                                 static_cast<std::int64_t>(end)});
                       });
      },
      kernel.any());
  return {};
}

}  // namespace hewn
