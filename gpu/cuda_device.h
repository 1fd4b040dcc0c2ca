#pragma once
/// NVIDIA GPUs as devices. This header needs no CUDA; a build without it has one that always fails.
#include <memory>

#include "core/compute/device.h"

namespace hewn {

/// Opens GPU `index` of compute capability 7.5 or newer. Its kernels and copies of one thread run
/// in order, those of different threads side by side (one stream each).
///
/// Fails with: Device (no driver, no such GPU, too old, built without CUDA), OutOfMemory.
Result<std::unique_ptr<Device>> open_cuda_device(int index);

}  // namespace hewn
