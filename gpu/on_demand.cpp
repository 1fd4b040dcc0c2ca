#include "core/base/module.h"
#include "core/compute/parallel.h"
#include "gpu/cuda_device.h"
#include "gpu/cuda_module.h"

namespace hewn {

Result<std::unique_ptr<Device>> open_cuda_device(int index) {
  const auto cuda = module_functions<CudaFunctions>(kCudaLibrary, kCudaSymbol);
  if (cuda) return (*cuda)->open(index, for_each_chunk);
  return Error{ErrorCode::Device, "the part of the program that needs CUDA cannot be loaded (" +
                                      cuda.error().message + "); keep " + kCudaLibrary +
                                      " beside the program"};
}

}  // namespace hewn
