#include "core/compute/curvature_job.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compute/kernels/kernels.h"

namespace hewn {
namespace {

/// Items of a kernel between two looks at the cancel token: some 20 ms of one core.
constexpr std::int64_t kItemsPerLaunch = std::int64_t{1} << 15;

}  // namespace

CurvatureJob::CurvatureJob(Device& device, const MeshArrays& mesh,
                           const CurvatureJobOptions& options, const RunContext& run)
    : job_(device),
      run_(run),
      slice_(device.info().is_accelerator ? INT64_MAX : kItemsPerLaunch),
      mesh_(job_, mesh) {
  find_boundaries(options);
  sum_normals(options);
  find_curvatures(options.limits);
}

Result<void> CurvatureJob::result() const {
  return is_cancelled_ ? RunContext::cancelled() : job_.result();
}

/// Launches `kernel` on all of `count` items, in slices between which a cancelled run ends.
template <class K>
void CurvatureJob::launch(K kernel, std::size_t count) {
  kernel.mesh = mesh_.form();
  const auto end = static_cast<std::int64_t>(count);
  while (kernel.range_end < end && !job_.has_failed()) {
    is_cancelled_ = is_cancelled_ || run_.is_cancelled();
    if (is_cancelled_) return;
    kernel.range_begin = kernel.range_end;
    kernel.range_end += std::min(slice_, end - kernel.range_begin);
    job_.launch(kernel);
  }
}

void CurvatureJob::find_boundaries(const CurvatureJobOptions& options) {
  vertex_classes_ = job_.allocate<VertexClass>(vertices());
  VertexClassKernel classify;
  classify.limits = {std::tan(options.ridge_angle_rad / 2), options.corner_ratio,
                     options.corner_defect_rad};
  classify.classes = vertex_classes_.data();
  launch(classify, vertices());

  is_marked_ = job_.allocate<bool>(triangles() * 3);
  marks_ = job_.allocate_filled<int>(vertices(), 0);
  BoundaryKernel mark;
  mark.classes = vertex_classes_.data();
  mark.ridge_angle = options.ridge_angle_rad;
  mark.is_marked = is_marked_.data();
  mark.marks = marks_.data();
  launch(mark, triangles());
}

void CurvatureJob::sum_normals(const CurvatureJobOptions& options) {
  normals_ = job_.allocate<PlainVec>(triangles() * 3);
  sectors_ = job_.allocate_filled<int>(triangles() * 3, 0xFF);
  GroupNormalKernel sum;
  sum.is_marked = is_marked_.data();
  sum.weights_are_angles = options.weights_are_angles;
  sum.normals = normals_.data();
  sum.sectors = sectors_.data();
  launch(sum, vertices());
}

void CurvatureJob::find_curvatures(const CurvatureLimits& limits) {
  const auto tensors = job_.allocate<CurvatureTensor>(triangles());
  TriangleTensorKernel differ;
  differ.normals = normals_.data();
  differ.tensors = tensors.data();
  launch(differ, triangles());

  const auto sums = job_.allocate_filled<CurvatureTensor>(triangles() * 3, 0);
  const auto weights = job_.allocate_filled<double>(triangles() * 3, 0);
  SectorTensorKernel average;
  average.normals = normals_.data();
  average.sectors = sectors_.data();
  average.tensors = tensors.data();
  average.sums = sums.data();
  average.weights = weights.data();
  launch(average, vertices());

  curvatures_ = job_.allocate<CurvatureForm>(triangles());
  classes_ = job_.allocate<CurvatureClass>(triangles());
  PrincipalKernel solve;
  solve.normals = normals_.data();
  solve.sectors = sectors_.data();
  solve.sums = sums.data();
  solve.limits = limits;
  solve.curvatures = curvatures_.data();
  solve.classes = classes_.data();
  launch(solve, triangles());
}

template <class T>
std::vector<T> CurvatureJob::taken(const DeviceBuffer<T>& from) {
  std::vector<T> to(from.size());
  job_.download(from, std::span<T>(to));
  return to;
}

std::vector<VertexClass> CurvatureJob::vertex_classes() { return taken(vertex_classes_); }
std::vector<int> CurvatureJob::vertex_marks() { return taken(marks_); }
std::vector<PlainVec> CurvatureJob::normals() { return taken(normals_); }
std::vector<int> CurvatureJob::sectors() { return taken(sectors_); }
std::vector<CurvatureForm> CurvatureJob::curvatures() { return taken(curvatures_); }
std::vector<CurvatureClass> CurvatureJob::classes() { return taken(classes_); }
void CurvatureJob::take_marks(std::span<bool> is_marked) { job_.download(is_marked_, is_marked); }

std::vector<int> CurvatureJob::regions() {
  const std::vector<CurvatureClass> known = classes();
  std::vector<int> regions(triangles());
  for (std::size_t t = 0; t < known.size(); ++t) {
    regions[t] = known[t] == CurvatureClass::None ? -1 : static_cast<int>(t);
  }
  auto labels = job_.upload(std::span<const int>(regions));
  auto next = job_.allocate<int>(triangles());
  for (int has_changed = 1; has_changed != 0 && !is_cancelled_ && !job_.has_failed();) {
    const auto flag = job_.allocate_filled<int>(1, 0);
    FloodKernel spread;
    spread.is_marked = is_marked_.data();
    spread.classes = classes_.data();
    spread.labels = labels.data();
    spread.next = next.data();
    spread.has_changed = flag.data();
    launch(spread, triangles());
    job_.download(flag, std::span<int>(&has_changed, 1));
    std::swap(labels, next);
  }
  job_.download(labels, std::span<int>(regions));
  return regions;
}

}  // namespace hewn
