#pragma once
/// The device that a test body runs on.
#include <array>
#include <memory>
#include <vector>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/compute/cpu_device.h"
#include "core/compute/kernels/surface_form.h"

namespace hewn::testing {

/// The GPU when HEWN_TEST_DEVICE is "cuda", else the processor. nullptr, after saying "SKIPPED:",
/// when there is no GPU.
std::unique_ptr<Device> device_under_test();

/// What `device_under_test` must agree with to the bit: one thread without vector instructions.
inline CpuDevice plain_device() {
  return CpuDevice(1, CpuDevice::kMemoryBudget, BitPath::Portable);
}

/// A surface of any kind that cuts the cube [-1, 1]^3.
SurfaceForm random_surface(Rng& rng);
std::vector<SurfaceForm> random_surfaces(std::size_t count, Rng& rng);
/// Uniform in the cube [-2, 2]^3.
std::vector<Vec3> random_points(std::size_t count, Rng& rng);

/// A shipped sample part, as far as these tests need it.
struct SamplePart {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  std::vector<SurfaceForm> planes;  ///< of each triangle
};
SamplePart read_sample_part();

}  // namespace hewn::testing
