#pragma once
/// Inside tests of many points at once on a mesh.
#include <array>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/base/run_context.h"
#include "core/compute/device.h"
#include "core/compute/kernels/winding_kernel.h"

namespace hewn {

/// A closed mesh, ready for inside tests: its triangles in a turned frame, and boxes around them.
/// Immutable.
class WindingTree {
 public:
  /// Requires: finite vertices, fewer than 2^30 triangles.
  /// Cost: O(n log n), and 120 bytes a triangle.
  WindingTree(std::span<const Vec3> vertices, std::span<const std::array<int, 3>> triangles,
              bool is_oriented);

  /// Tells of each point whether it is inside. What is `Unsure` (for points off the surface a
  /// matter of one in 10^9) another method must decide.
  ///
  /// Requires: `out.size() == points.size()`.
  /// Fails with: the device's errors, Cancelled.
  /// Cost: as `WindingKernel`, in parts that fit into the device's memory beside the mesh.
  Result<void> find_inside(Device& device, std::span<const Vec3> points, std::span<Inside> out,
                           const RunContext& run) const;

  /// Estimate for `Compute::run`: measured on one core (docs/performance.md).
  static double seconds_for(std::size_t points) { return 5e-7 * static_cast<double>(points); }

 private:
  WindingKernel frame_;  ///< without memory
  std::vector<ShadowNode> nodes_;
  std::vector<RaisedTriangle> triangles_;
};

}  // namespace hewn
