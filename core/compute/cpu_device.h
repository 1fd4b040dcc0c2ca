#pragma once
/// The processor as a device: every kernel on all cores, with the widest vector units it has.
#include "core/compute/bits.h"
#include "core/compute/device.h"

namespace hewn {

/// Never fails; throws std::bad_alloc like any other code when memory runs out.
class CpuDevice final : public Device {
 public:
  /// Parts of a job are made to take no more than this.
  static constexpr std::size_t kMemoryBudget = std::size_t{1} << 30;

  /// `threads` as in `for_each_chunk`. `path` is for tests and benchmarks.
  /// Requires: `bit_kernels(path) != nullptr`.
  explicit CpuDevice(int threads, std::size_t memory_budget = kMemoryBudget,
                     BitPath path = bit_kernels().path);

  const DeviceInfo& info() const override { return info_; }
  Result<void*> allocate(std::size_t bytes) override;
  void release(void* memory) override;
  Result<void> upload(void* to, const void* from, std::size_t bytes) override;
  Result<void> download(void* to, const void* from, std::size_t bytes) override;
  Result<void> fill(void* to, unsigned char byte, std::size_t bytes) override;
  Result<void> launch(const Kernel& kernel) override;

 private:
  DeviceInfo info_;
  int threads_;
  BitPath path_;
};

}  // namespace hewn
