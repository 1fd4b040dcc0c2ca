#pragma once
/// What the GPU itself can do, to judge kernels by.
#include "core/base/result.h"

namespace hewn {

struct Ceilings {
  double logic = 0;    ///< 32-bit logic operations of three operands a second
  double doubles = 0;  ///< additions or multiplications in double precision a second
  double bytes = 0;    ///< read or written a second
};

/// Measures GPU `index`. Fails with: Device (also without CUDA), OutOfMemory.
Result<Ceilings> measure_ceilings(int index);

}  // namespace hewn
