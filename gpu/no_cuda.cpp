/// Stands in for cuda_device.cu where nvcc is missing or HEWN_CUDA is OFF.
#include "gpu/cuda_device.h"

namespace hewn {

Result<std::unique_ptr<Device>> open_cuda_device(int) {
  return Error{ErrorCode::Device,
               "this build has no CUDA; install nvcc and configure with -DHEWN_CUDA=ON"};
}

}  // namespace hewn
