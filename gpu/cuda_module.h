#pragma once
/// CUDA behind a library that is loaded when a GPU is first wanted: with it, every command took 1.3
/// ms longer to start. Private to gpu/.
#include <cstddef>
#include <functional>
#include <memory>

#include "core/compute/device.h"

namespace hewn {

/// `for_each_chunk` of core/compute/parallel.h: the library has nothing of the layers but their
/// headers.
using ChunkLoop = void (*)(int threads, std::size_t n, std::size_t grain,
                           const std::function<void(std::size_t, std::size_t)>& body);

struct CudaFunctions {
  /// As `open_cuda_device`.
  Result<std::unique_ptr<Device>> (*open)(int index, ChunkLoop loop);
};

/// The library's file; it lies beside the program.
inline constexpr const char* kCudaLibrary = "libhewn-cuda.so";
/// Its one symbol: a `const CudaFunctions* ()`.
inline constexpr const char* kCudaSymbol = "hewn_cuda_functions";

}  // namespace hewn
