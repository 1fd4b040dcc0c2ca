#include "core/compute/winding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/assert.h"
#include "core/compute/kernels/kernels.h"

namespace hewn {
namespace {

constexpr std::int32_t kTrianglesPerLeaf = 4;
/// Points between two looks at the cancel token: some 30 ms of one core, or 10 ms of a GPU.
constexpr std::size_t kPointsPerLaunch = std::size_t{1} << 16;
constexpr std::size_t kPointsPerAcceleratedLaunch = std::size_t{1} << 22;

PlainVec plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// Upwards in the frame: no small integers have its components' ratios, so that faces and edges of
/// a CAD part seldom stand upright.
const Vec3 kUp(0.5773991, 0.3317541, 0.7460673);

float rounded_down(double value) {
  const auto near = static_cast<float>(value);
  return near > value ? std::nextafter(near, -std::numeric_limits<float>::infinity()) : near;
}
float rounded_up(double value) { return -rounded_down(-value); }

/// What `ShadowNode` tells of triangles, in double precision.
struct Shadow {
  double low_x = kInfinity, high_x = -kInfinity, low_y = kInfinity, high_y = -kInfinity,
         high_z = -kInfinity;

  void add(const PlainVec& p) {
    low_x = std::min(low_x, p.x);
    high_x = std::max(high_x, p.x);
    low_y = std::min(low_y, p.y);
    high_y = std::max(high_y, p.y);
    high_z = std::max(high_z, p.z);
  }
};

/// Sorts the triangles as it goes: each node's half with the lower centres comes first.
class NodeBuilder {
 public:
  NodeBuilder(std::vector<RaisedTriangle>& triangles, std::vector<ShadowNode>& nodes)
      : triangles_(triangles), nodes_(nodes) {}

  void build(std::int32_t begin, std::int32_t end) {
    Shadow shadow;
    for (std::int32_t t = begin; t < end; ++t) {
      for (const PlainVec* corner : {&at(t).a, &at(t).b, &at(t).c}) shadow.add(*corner);
    }
    const std::size_t own = nodes_.size();
    nodes_.push_back({rounded_down(shadow.low_x), rounded_up(shadow.high_x),
                      rounded_down(shadow.low_y), rounded_up(shadow.high_y),
                      rounded_up(shadow.high_z)});
    if (end - begin <= kTrianglesPerLeaf) {
      nodes_[own].first_triangle = begin;
      nodes_[own].triangles = end - begin;
    } else {
      const std::int32_t middle = begin + (end - begin) / 2;
      const bool is_wide = shadow.high_x - shadow.low_x >= shadow.high_y - shadow.low_y;
      divide(begin, middle, end, is_wide ? &PlainVec::x : &PlainVec::y);
      build(begin, middle);
      build(middle, end);
    }
    nodes_[own].next = static_cast<std::int32_t>(nodes_.size());
  }

 private:
  RaisedTriangle& at(std::int32_t t) { return triangles_[static_cast<std::size_t>(t)]; }
  void divide(std::int32_t begin, std::int32_t middle, std::int32_t end, double PlainVec::*along) {
    const auto center = [along](const RaisedTriangle& t) {
      return t.a.*along + t.b.*along + t.c.*along;
    };
    std::nth_element(
        triangles_.begin() + begin, triangles_.begin() + middle, triangles_.begin() + end,
        [&](const RaisedTriangle& s, const RaisedTriangle& t) { return center(s) < center(t); });
  }

  std::vector<RaisedTriangle>& triangles_;
  std::vector<ShadowNode>& nodes_;
};

}  // namespace

WindingTree::WindingTree(std::span<const Vec3> vertices,
                         std::span<const std::array<int, 3>> triangles, bool is_oriented) {
  HEWN_ASSERT(triangles.size() < std::size_t{1} << 30, "too many triangles for 32-bit numbers");
  frame_.is_oriented = is_oriented;
  Box3 box;
  for (const Vec3& v : vertices) box.extend(v);
  const double unit = box.is_empty() || !(box.diagonal() > 0) ? 1 : box.diagonal();
  const Vec3 center = box.is_empty() ? Vec3(Vec3::Zero()) : box.center();
  const Vec3 up = kUp.normalized();
  const PlainFrame frame = frame_of(plain(up));
  frame_.center = plain(center);
  frame_.across = frame.u * (1 / unit);
  frame_.along = frame.w * (1 / unit);
  frame_.up = plain(up) * (1 / unit);
  const auto raised = [&](int vertex) {
    const PlainVec v = plain(vertices[static_cast<std::size_t>(vertex)]) - frame_.center;
    return PlainVec{dot(frame_.across, v), dot(frame_.along, v), dot(frame_.up, v)};
  };
  triangles_.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) triangles_.push_back({raised(a), raised(b), raised(c)});
  if (triangles_.empty()) return;
  nodes_.reserve(triangles_.size());
  NodeBuilder(triangles_, nodes_).build(0, static_cast<std::int32_t>(triangles_.size()));
}

Result<void> WindingTree::find_inside(Device& device, std::span<const Vec3> points,
                                      std::span<Inside> out, const RunContext& run) const {
  static_assert(sizeof(Vec3) == sizeof(PlainVec));
  const std::size_t part =
      device.info().is_accelerator ? kPointsPerAcceleratedLaunch : kPointsPerLaunch;
  DeviceJob job(device);
  const auto nodes = job.upload(std::span<const ShadowNode>(nodes_));
  const auto triangles = job.upload(std::span<const RaisedTriangle>(triangles_));
  WindingKernel kernel = frame_;
  kernel.nodes = nodes.data();
  kernel.node_count = static_cast<std::int32_t>(nodes.size());
  kernel.triangles = triangles.data();
  for (std::size_t begin = 0; begin < points.size() && !job.has_failed(); begin += part) {
    if (run.is_cancelled()) return RunContext::cancelled();
    const std::size_t count = std::min(part, points.size() - begin);
    const auto positions =
        job.upload(std::span(reinterpret_cast<const PlainVec*>(points.data() + begin), count));
    const auto inside = job.allocate<Inside>(count);
    kernel.points = positions.data();
    kernel.point_count = static_cast<std::int64_t>(count);
    kernel.inside = inside.data();
    job.launch(kernel);
    job.download(inside, out.subspan(begin, count));
  }
  return job.result();
}

}  // namespace hewn
