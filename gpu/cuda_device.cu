#include <algorithm>

#include <cuda_runtime.h>

#include "core/compute/kernels/kernels.h"
#include "gpu/cuda_module.h"
#include "gpu/pinned_stage.h"

namespace hewn {
namespace {

constexpr int kThreadsPerBlock = 256;
/// Enough blocks to fill every multiprocessor, few enough to start quickly.
constexpr std::int64_t kBlocksPerMultiprocessor = 16;
/// Of the memory that is free at the start, a job may take this share.
constexpr double kBudgetShare = 0.75;
/// GPUs of this compute capability and newer have machine code or PTX in the program.
constexpr int kLeastMajor = 7;
constexpr int kLeastMinor = 5;

/// Every item of a kernel. Warps stay whole: the stride and all kernels' numbers of items that need
/// it are multiples of 32.
template <class Grain, class K>
__global__ void __launch_bounds__(kThreadsPerBlock) run_items(const K kernel, std::int64_t items) {
  const std::int64_t stride = static_cast<std::int64_t>(gridDim.x) * blockDim.x;
  for (std::int64_t i = static_cast<std::int64_t>(blockIdx.x) * blockDim.x + threadIdx.x; i < items;
       i += stride) {
    kernel.template run<Grain>(i);
  }
}

Error error_of(cudaError_t code, const std::string& device) {
  // Errors that do not damage the device's state would otherwise show up in the next call.
  cudaGetLastError();
  if (code == cudaErrorMemoryAllocation) {
    return {ErrorCode::OutOfMemory, "too little memory on the GPU", device};
  }
  return {ErrorCode::Device, std::string("the GPU failed: ") + cudaGetErrorString(code), device};
}

class CudaDevice final : public Device {
 public:
  CudaDevice(int index, const cudaDeviceProp& properties, std::size_t memory_budget, ChunkLoop loop)
      : info_{properties.name, true, memory_budget},
        index_(index),
        most_blocks_(properties.multiProcessorCount * kBlocksPerMultiprocessor),
        stage_(loop) {}

  const DeviceInfo& info() const override { return info_; }

  Result<void*> allocate(std::size_t bytes) override {
    void* memory = nullptr;
    const cudaError_t code =
        on_device([&] { return cudaMallocAsync(&memory, bytes, cudaStreamPerThread); });
    if (code != cudaSuccess) return error_of(code, info_.name);
    return memory;
  }

  void release(void* memory) override {
    // A failure here shows in the next download; the memory is lost with the device then.
    on_device([&] { return cudaFreeAsync(memory, cudaStreamPerThread); });
  }

  Result<void> upload(void* to, const void* from, std::size_t bytes) override {
    return checked(on_device([&] {
      if (bytes >= PinnedStage::kLeastBytes) return stage_.upload(to, from, bytes);
      // From pageable memory: returns when `from` may change.
      return cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, cudaStreamPerThread);
    }));
  }

  Result<void> download(void* to, const void* from, std::size_t bytes) override {
    return checked(on_device([&] {
      if (bytes >= PinnedStage::kLeastBytes) return stage_.download(to, from, bytes);
      const cudaError_t code =
          cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, cudaStreamPerThread);
      return code == cudaSuccess ? cudaStreamSynchronize(cudaStreamPerThread) : code;
    }));
  }

  Result<void> fill(void* to, unsigned char byte, std::size_t bytes) override {
    return checked(
        on_device([&] { return cudaMemsetAsync(to, byte, bytes, cudaStreamPerThread); }));
  }

  Result<void> launch(const Kernel& kernel) override {
    return checked(on_device([&] {
      std::visit([this](const auto& k) { start(k); }, kernel.any());
      return cudaGetLastError();
    }));
  }

 private:
  template <class K>
  void start(const K& kernel) const {
    start_with<DeviceGrain>(kernel);
  }
  void start(const TreeKernel& kernel) const {
    // Only whole groups of the wide kinds are worth it.
    if (kernel.words % TreeKernel::kGroupWords<WideDeviceGrain> == 0) {
      start_with<WideDeviceGrain>(kernel);
    } else if (kernel.words % TreeKernel::kGroupWords<PairedDeviceGrain> == 0) {
      start_with<PairedDeviceGrain>(kernel);
    } else {
      start_with<DeviceGrain>(kernel);
    }
  }

  template <class Grain, class K>
  void start_with(const K& kernel) const {
    const std::int64_t items = kernel.template items<Grain>();
    if (items == 0) return;
    const std::int64_t blocks =
        std::min<std::int64_t>(most_blocks_, (items + kThreadsPerBlock - 1) / kThreadsPerBlock);
    run_items<Grain><<<static_cast<unsigned>(blocks), kThreadsPerBlock, 0, cudaStreamPerThread>>>(
        kernel, items);
  }

  /// Threads have a current device each.
  template <class Call>
  cudaError_t on_device(const Call& call) const {
    const cudaError_t code = cudaSetDevice(index_);
    return code == cudaSuccess ? call() : code;
  }

  Result<void> checked(cudaError_t code) const {
    return code == cudaSuccess ? Result<void>() : Result<void>(error_of(code, info_.name));
  }

  DeviceInfo info_;
  int index_;
  std::int64_t most_blocks_;
  PinnedStage stage_;
};

Error not_usable(int index, const std::string& why) {
  cudaGetLastError();
  return {ErrorCode::Device, "no CUDA device " + std::to_string(index) + ": " + why};
}

/// Freed memory stays with the program, so that allocations cost nothing after the first ones.
cudaError_t keep_freed_memory(int index) {
  cudaMemPool_t pool = nullptr;
  const cudaError_t code = cudaDeviceGetDefaultMemPool(&pool, index);
  if (code != cudaSuccess) return code;
  std::uint64_t everything = UINT64_MAX;
  return cudaMemPoolSetAttribute(pool, cudaMemPoolAttrReleaseThreshold, &everything);
}

Result<std::unique_ptr<Device>> open_device(int index, ChunkLoop loop) {
  int count = 0;
  cudaError_t code = cudaGetDeviceCount(&count);
  // "No driver", "driver too old" and "no GPU" have messages of their own.
  if (code != cudaSuccess) return not_usable(index, cudaGetErrorString(code));
  if (index < 0 || index >= count) {
    return not_usable(index, "there are only " + std::to_string(count));
  }
  cudaDeviceProp properties;
  code = cudaGetDeviceProperties(&properties, index);
  if (code != cudaSuccess) return not_usable(index, cudaGetErrorString(code));
  const bool is_too_old = properties.major < kLeastMajor ||
                          (properties.major == kLeastMajor && properties.minor < kLeastMinor);
  if (is_too_old || properties.memoryPoolsSupported == 0) {
    return not_usable(index,
                      std::string(properties.name) +
                          " is too old (compute capability 7.5 and memory pools are needed)");
  }
  std::size_t free_bytes = 0;
  std::size_t total_bytes = 0;
  code = cudaSetDevice(index);
  if (code == cudaSuccess) code = cudaMemGetInfo(&free_bytes, &total_bytes);
  if (code == cudaSuccess) code = keep_freed_memory(index);
  if (code != cudaSuccess) return error_of(code, properties.name);
  const auto budget = static_cast<std::size_t>(static_cast<double>(free_bytes) * kBudgetShare);
  return std::unique_ptr<Device>(new CudaDevice(index, properties, budget, loop));
}

}  // namespace
}  // namespace hewn

/// What `open_cuda_device` looks up.
extern "C" __attribute__((visibility("default"))) const hewn::CudaFunctions* hewn_cuda_functions() {
  static constexpr hewn::CudaFunctions kFunctions{hewn::open_device};
  return &kFunctions;
}
