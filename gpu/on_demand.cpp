#include "core/base/module.h"
#include "core/compute/parallel.h"
#include "gpu/cuda_device.h"
#include "gpu/cuda_module.h"

namespace hewn {

Result<std::unique_ptr<Device>> open_cuda_device(int index) {
  using Symbol = const CudaFunctions* (*)();
  const Result<void*> symbol = module_symbol(kCudaLibrary, kCudaSymbol);
  if (symbol) return reinterpret_cast<Symbol>(*symbol)()->open(index, for_each_chunk);
  return Error{ErrorCode::Device, "the part of the program that needs CUDA cannot be loaded (" +
                                      symbol.error().message + "); keep " + kCudaLibrary +
                                      " beside the program"};
}

}  // namespace hewn
