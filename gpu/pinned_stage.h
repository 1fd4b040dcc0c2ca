#pragma once
/// Large copies between the host's memory and a GPU's by way of pinned memory.
#include <cstddef>
#include <mutex>

#include <cuda_runtime.h>

#include "gpu/cuda_module.h"

namespace hewn {

/// GPUs reach pinned memory several times faster than other memory. Two halves of it take turns:
/// while the GPU copies one, the processor's threads copy the other. Thread-safe.
class PinnedStage {
 public:
  /// Smaller copies gain nothing.
  static constexpr std::size_t kLeastBytes = std::size_t{4} << 20;

  /// `loop` has the processor's threads copy.
  explicit PinnedStage(ChunkLoop loop) : loop_(loop) {}
  PinnedStage(const PinnedStage&) = delete;
  PinnedStage& operator=(const PinnedStage&) = delete;
  ~PinnedStage();

  /// In the calling thread's stream, on its current device. `from` may change after the return.
  cudaError_t upload(void* to, const void* from, std::size_t bytes);
  /// Returns when everything has arrived.
  cudaError_t download(void* to, const void* from, std::size_t bytes);

 private:
  cudaError_t prepare();
  void copy(char* to, const char* from, std::size_t bytes) const;
  char* half(std::size_t chunk) const;

  ChunkLoop loop_;
  std::mutex mutex_;
  char* memory_ = nullptr;
  cudaEvent_t copied_[2] = {nullptr, nullptr};  ///< by the GPU, each half
};

}  // namespace hewn
