#pragma once
/// Curvature of a mesh and what it suggests, stage by stage on one device.
#include <vector>

#include "core/base/run_context.h"
#include "core/compute/kernels/curvature_kernels.h"
#include "core/compute/kernels/vertex_class_kernel.h"
#include "core/compute/mesh_on_device.h"

namespace hewn {

struct CurvatureJobOptions {
  double ridge_angle_rad = 0;
  double corner_ratio = 0;
  double corner_defect_rad = 0;
  bool weights_are_angles = false;  ///< of triangles in a vertex's normal; else areas
  CurvatureLimits limits;
};

/// Runs the stages on construction; their results stay on the device until they are taken. A
/// failure or a cancelled run shows in `result`, and what is taken then is of no use.
/// Memory: some 400 bytes a triangle. The same bits on every device.
class CurvatureJob {
 public:
  /// `mesh` and `run` must outlive it.
  CurvatureJob(Device& device, const MeshArrays& mesh, const CurvatureJobOptions& options,
               const RunContext& run);

  Result<void> result() const;

  std::vector<VertexClass> vertex_classes();
  /// By corner number: whether the side is marked that begins there.
  void take_marks(std::span<bool> is_marked);
  /// Twice the number of marked edges at each vertex.
  std::vector<int> vertex_marks();
  std::vector<PlainVec> normals();  ///< by corner number
  std::vector<int> sectors();       ///< by corner number
  std::vector<CurvatureForm> curvatures();
  std::vector<CurvatureClass> classes();  ///< of triangles
  /// Each triangle's region by flooding, named by its lowest triangle; -1 without area.
  std::vector<int> regions();

 private:
  std::size_t triangles() const { return static_cast<std::size_t>(mesh_.form().triangle_count); }
  std::size_t vertices() const { return static_cast<std::size_t>(mesh_.form().vertex_count); }
  template <class K>
  void launch(K kernel, std::size_t count);
  template <class T>
  std::vector<T> taken(const DeviceBuffer<T>& from);
  void find_boundaries(const CurvatureJobOptions& options);
  void sum_normals(const CurvatureJobOptions& options);
  void find_curvatures(const CurvatureLimits& limits);

  DeviceJob job_;
  const RunContext& run_;
  std::int64_t slice_;
  bool is_cancelled_ = false;
  MeshOnDevice mesh_;
  DeviceBuffer<VertexClass> vertex_classes_;
  DeviceBuffer<bool> is_marked_;
  DeviceBuffer<int> marks_, sectors_;
  DeviceBuffer<PlainVec> normals_;
  DeviceBuffer<CurvatureForm> curvatures_;
  DeviceBuffer<CurvatureClass> classes_;
};

}  // namespace hewn
