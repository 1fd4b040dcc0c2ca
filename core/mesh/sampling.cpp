#include "core/mesh/sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/assert.h"

namespace hewn {
namespace {

std::vector<int> all_triangles(const Mesh& mesh) {
  std::vector<int> triangles(mesh.triangles.size());
  std::iota(triangles.begin(), triangles.end(), 0);
  return triangles;
}

}  // namespace

SurfaceSampler::SurfaceSampler(const Mesh& mesh) : SurfaceSampler(mesh, all_triangles(mesh)) {}

SurfaceSampler::SurfaceSampler(const Mesh& mesh, std::vector<int> triangles)
    : mesh_(&mesh), triangles_(std::move(triangles)) {
  // A zero-area triangle can never be drawn; leaving it out keeps `is_empty` honest.
  std::erase_if(triangles_, [&](int t) { return !(mesh.areas[t] > 0); });
  cumulative_area_.reserve(triangles_.size());
  double sum = 0;
  for (const int t : triangles_) cumulative_area_.push_back(sum += mesh.areas[t]);
}

SurfacePoint SurfaceSampler::draw(Rng& rng) const {
  HEWN_ASSERT(!is_empty(), "nothing to draw from");
  const double target = rng.uniform() * cumulative_area_.back();
  const auto found = std::upper_bound(cumulative_area_.begin(), cumulative_area_.end(), target);
  const std::size_t i =
      std::min<std::size_t>(found - cumulative_area_.begin(), triangles_.size() - 1);
  const int triangle = triangles_[i];
  return {sample_triangle(*mesh_, triangle, rng), mesh_->normals[triangle], triangle};
}

Vec3 sample_box(const Box3& box, Rng& rng) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = rng.uniform(box.lo[k], box.hi[k]);
  return p;
}

Line draw_line(const Vec3& center, double radius, Rng& rng) {
  const double z = rng.uniform(-1, 1);
  const double turn = rng.uniform(0, 2 * kPi);
  const double flat = std::sqrt(std::max(0.0, 1 - z * z));
  const Vec3 direction(flat * std::cos(turn), flat * std::sin(turn), z);
  const double reach = radius * std::sqrt(rng.uniform());
  const double angle = rng.uniform(0, 2 * kPi);
  const Tangents frame = tangents(direction);
  const Vec3 middle = center + reach * (std::cos(angle) * frame.u + std::sin(angle) * frame.w);
  return {middle - 2 * radius * direction, direction};
}

Vec3 sample_triangle(const Mesh& mesh, int triangle, Rng& rng) {
  const double root = std::sqrt(rng.uniform());
  const double share = rng.uniform();
  const Vec3 a = mesh.corner(triangle, 0);
  const Vec3 ab = mesh.corner(triangle, 1) - a;
  const Vec3 ac = mesh.corner(triangle, 2) - a;
  return a + ab * (root * (1 - share)) + ac * (root * share);
}

}  // namespace hewn
