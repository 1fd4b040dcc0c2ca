#include "core/mesh/compare.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/compute/parallel.h"
#include "core/mesh/sampling.h"

namespace hewn {
namespace {

constexpr std::size_t kGrain = 512;

/// Distances of the points to the surface, in input order.
Result<std::vector<double>> measure(const MeshQuery& to, const std::vector<Vec3>& points,
                                    const RunContext& run) {
  std::vector<double> distances(points.size());
  for_each_chunk(run.threads, points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    if (run.is_cancelled()) return;
    for (std::size_t i = begin; i < end; ++i) distances[i] = to.closest(points[i]).distance;
  });
  if (run.is_cancelled()) return RunContext::cancelled();
  return distances;
}

Result<OneSidedDistance> measure_one_side(const MeshQuery& from, const MeshQuery& to, int samples,
                                          Rng rng, const RunContext& run) {
  const SurfaceSampler sampler(from.mesh());
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(samples) + from.mesh().vertices.size());
  for (int i = 0; i < samples; ++i) points.push_back(sampler.draw(rng).position);
  // The far points of a surface are mostly its corners, which random points miss.
  for (const Vec3& v : from.mesh().vertices) points.push_back(v);
  Result<std::vector<double>> distances = measure(to, points, run);
  if (!distances) return distances.error();
  OneSidedDistance result;
  result.max = *std::max_element(distances->begin(), distances->end());
  distances->resize(static_cast<std::size_t>(samples));
  if (samples == 0) return result;
  double sum = 0;
  for (const double d : *distances) sum += d;
  result.mean = sum / samples;
  const auto rank = static_cast<std::ptrdiff_t>(0.999 * (samples - 1));
  std::nth_element(distances->begin(), distances->begin() + rank, distances->end());
  result.p999 = (*distances)[static_cast<std::size_t>(rank)];
  return result;
}

Result<double> measure_iou(const MeshQuery& a, const MeshQuery& b, int samples,
                           const RunContext& run) {
  Box3 box = a.mesh().bounds;
  box.extend(b.mesh().bounds.lo);
  box.extend(b.mesh().bounds.hi);
  std::vector<Vec3> points(static_cast<std::size_t>(samples));
  // One random stream per chunk: the points do not depend on who draws them.
  for_each_index(run.threads, (points.size() + kGrain - 1) / kGrain, [&](std::size_t chunk) {
    Rng rng(run.seed, 0x10000 + chunk);
    const std::size_t end = std::min(points.size(), (chunk + 1) * kGrain);
    for (std::size_t i = chunk * kGrain; i < end; ++i) points[i] = sample_box(box, rng);
  });
  const std::vector<char> in_a = a.contains(points, run);
  const std::vector<char> in_b = b.contains(points, run);
  if (run.is_cancelled()) return RunContext::cancelled();
  std::size_t common_sum = 0;
  std::size_t joint_sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    common_sum += in_a[i] != 0 && in_b[i] != 0 ? 1 : 0;
    joint_sum += in_a[i] != 0 || in_b[i] != 0 ? 1 : 0;
  }
  if (joint_sum == 0) return 1.0;
  return static_cast<double>(common_sum) / static_cast<double>(joint_sum);
}

void divide(OneSidedDistance& d, double diagonal) {
  d.max /= diagonal;
  d.mean /= diagonal;
  d.p999 /= diagonal;
}

}  // namespace

Result<MeshDifference> compare_meshes(const MeshQuery& a, const MeshQuery& b,
                                      const CompareOptions& options, const RunContext& run) {
  for (const MeshQuery* query : {&a, &b}) {
    if (query->mesh().total_area > 0) continue;
    return Error{ErrorCode::BadMesh, "a mesh without area cannot be compared", {}};
  }
  MeshDifference difference;
  run.report("comparing", 0);
  const auto there = measure_one_side(a, b, options.surface_samples, Rng(run.seed, 1), run);
  if (!there) return there.error();
  run.report("comparing", 0.35);
  const auto back = measure_one_side(b, a, options.surface_samples, Rng(run.seed, 2), run);
  if (!back) return back.error();
  run.report("comparing", 0.7);
  const auto iou = measure_iou(a, b, options.volume_samples, run);
  if (!iou) return iou.error();
  difference.a_to_b = *there;
  difference.b_to_a = *back;
  divide(difference.a_to_b, a.mesh().diagonal());
  divide(difference.b_to_a, a.mesh().diagonal());
  difference.hausdorff = std::max(difference.a_to_b.max, difference.b_to_a.max);
  difference.mean = (difference.a_to_b.mean + difference.b_to_a.mean) / 2;
  difference.p999 = std::max(difference.a_to_b.p999, difference.b_to_a.p999);
  difference.iou = *iou;
  run.report("comparing", 1);
  return difference;
}

}  // namespace hewn
