#include <algorithm>
#include <functional>

#include <cuda_runtime.h>

#include "bench/devices/ceilings.h"

namespace hewn {
namespace {

constexpr int kThreads = 256;
constexpr int kSteps = 4096;
constexpr int kChains = 8;  ///< independent ones in each thread, to hide what a step takes
constexpr std::size_t kCopyBytes = std::size_t{1} << 30;
constexpr int kRounds = 5;

__global__ void __launch_bounds__(kThreads) logic_steps(unsigned* out, unsigned seed) {
  unsigned x[kChains];
  for (int c = 0; c < kChains; ++c) x[c] = seed + threadIdx.x * kChains + c;
  for (int step = 0; step < kSteps; ++step) {
    // No two of them make one, and none can be left out.
#pragma unroll
    for (int c = 0; c < kChains; ++c) {
      x[c] = (x[c] & x[(c + 1) % kChains]) ^ x[(c + 3) % kChains];
    }
  }
  unsigned all = 0;
  for (int c = 0; c < kChains; ++c) all ^= x[c];
  out[blockIdx.x * kThreads + threadIdx.x] = all;
}

__global__ void __launch_bounds__(kThreads) double_steps(double* out, double seed) {
  double x[kChains];
  for (int c = 0; c < kChains; ++c) x[c] = seed + c;
  for (int step = 0; step < kSteps; ++step) {
#pragma unroll
    for (int c = 0; c < kChains; ++c) x[c] = x[c] + seed;
  }
  double all = 0;
  for (int c = 0; c < kChains; ++c) all += x[c];
  out[blockIdx.x * kThreads + threadIdx.x] = all;
}

Error error_of(cudaError_t code) {
  return {code == cudaErrorMemoryAllocation ? ErrorCode::OutOfMemory : ErrorCode::Device,
          cudaGetErrorString(code)};
}

/// Seconds of the quickest of several rounds after one to warm up; negative: it failed.
double quickest_seconds(const std::function<void()>& enqueue) {
  cudaEvent_t begin = nullptr;
  cudaEvent_t end = nullptr;
  cudaEventCreate(&begin);
  cudaEventCreate(&end);
  float best_ms = 1e30f;
  for (int round = 0; round <= kRounds; ++round) {
    cudaEventRecord(begin);
    enqueue();
    cudaEventRecord(end);
    float ms = 0;
    if (cudaEventSynchronize(end) != cudaSuccess) return -1;
    cudaEventElapsedTime(&ms, begin, end);
    if (round > 0) best_ms = std::min(best_ms, ms);
  }
  cudaEventDestroy(begin);
  cudaEventDestroy(end);
  return 1e-3 * static_cast<double>(best_ms);
}

}  // namespace

Result<Ceilings> measure_ceilings(int index) {
  cudaDeviceProp properties;
  cudaError_t code = cudaSetDevice(index);
  if (code == cudaSuccess) code = cudaGetDeviceProperties(&properties, index);
  if (code != cudaSuccess) return error_of(code);
  char* memory = nullptr;
  code = cudaMalloc(&memory, 2 * kCopyBytes);
  if (code != cudaSuccess) return error_of(code);
  const auto blocks = static_cast<unsigned>(8 * properties.multiProcessorCount);
  const double steps = static_cast<double>(blocks) * kThreads * kSteps * kChains;
  const double logic_s = quickest_seconds(
      [&] { logic_steps<<<blocks, kThreads>>>(reinterpret_cast<unsigned*>(memory), 12345u); });
  const double double_s = quickest_seconds(
      [&] { double_steps<<<blocks, kThreads>>>(reinterpret_cast<double*>(memory), 1.5); });
  const double copy_s = quickest_seconds(
      [&] { cudaMemcpyAsync(memory + kCopyBytes, memory, kCopyBytes, cudaMemcpyDeviceToDevice); });
  code = cudaGetLastError();
  cudaFree(memory);
  if (code != cudaSuccess || logic_s < 0 || double_s < 0 || copy_s < 0) return error_of(code);
  return Ceilings{steps / logic_s, steps / double_s, 2 * static_cast<double>(kCopyBytes) / copy_s};
}

}  // namespace hewn
