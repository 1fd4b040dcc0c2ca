/// Stands in for ceilings.cu where there is no CUDA.
#include "bench/devices/ceilings.h"

namespace hewn {

Result<Ceilings> measure_ceilings(int) {
  return Error{ErrorCode::Device, "this build has no CUDA"};
}

}  // namespace hewn
