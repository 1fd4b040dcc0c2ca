#pragma once
/// A mesh with its adjacency in a device's memory.
#include <array>

#include "core/base/math.h"
#include "core/compute/device.h"
#include "core/compute/kernels/mesh_form.h"

namespace hewn {

/// What kernels need of a mesh, as it lies in the host's memory (`MeshForm` has the meanings).
struct MeshArrays {
  std::span<const Vec3> vertices;
  std::span<const std::array<int, 3>> triangles;
  std::span<const Vec3> normals;
  std::span<const double> areas;
  std::span<const std::array<int, 3>> neighbors;
  std::span<const int> corners;
  std::span<const int> first_corner;
};

/// Uploaded once, for all kernels of a job. Some 100 bytes a triangle.
class MeshOnDevice {
 public:
  MeshOnDevice(DeviceJob& job, const MeshArrays& mesh);

  const MeshForm& form() const { return form_; }

 private:
  DeviceBuffer<PlainVec> vertices_, normals_;
  DeviceBuffer<int> triangles_, neighbors_, corners_, first_corner_;
  DeviceBuffer<double> areas_;
  MeshForm form_;
};

}  // namespace hewn
