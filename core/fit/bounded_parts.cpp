#include "core/fit/bounded_parts.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace hewn {
namespace {

/// Directions of one surface set are parallel exactly or not at all; this absorbs rounding.
constexpr double kParallel = 1e-9;
/// How far boxes for halfspaces reach beyond the mesh, in diagonals.
constexpr double kBeyond = 0.05;

/// Index of the coordinate with the largest magnitude; the first of equal ones.
int main_coordinate(const Vec3& v) {
  int index = 0;
  v.cwiseAbs().maxCoeff(&index);
  return index;
}

Vec3 positive(const Vec3& v) { return v[main_coordinate(v)] < 0 ? Vec3(-v) : v; }

/// Rounded, so that frames that differ in their last bits are put in the same order.
std::array<std::int64_t, 4> order_key(const Vec3& v, int k) {
  const auto rounded = [](double x) { return static_cast<std::int64_t>(std::llround(x * 1e8)); };
  return {rounded(std::abs(v[k])), rounded(v[0]), rounded(v[1]), rounded(v[2])};
}

}  // namespace

Interval extent_along(const Mesh& mesh, std::span<const int> triangles, const Vec3& direction) {
  Interval extent;
  for (const int t : triangles) {
    for (int k = 0; k < 3; ++k) extent.extend(direction.dot(mesh.corner(t, k)));
  }
  return extent;
}

Mat3 rotation_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  std::array<Vec3, 3> rest{positive(a), positive(b), positive(c)};
  Mat3 rotation;
  for (int k = 0; k < 3; ++k) {
    const auto best = std::max_element(
        rest.begin() + k, rest.end(),
        [&](const Vec3& p, const Vec3& q) { return order_key(p, k) < order_key(q, k); });
    std::swap(rest[k], *best);
    // Adding zero turns -0 into +0.
    rotation.col(k) = (rest[k][k] < 0 ? Vec3(-rest[k]) : rest[k]) + Vec3::Zero();
  }
  if (rotation.determinant() < 0) rotation.col(2) = -rotation.col(2) + Vec3::Zero();
  return rotation;
}

Mat3 rotation_about(const Vec3& axis) {
  const int k = main_coordinate(axis);
  const Vec3 z = (axis[k] < 0 ? Vec3(-axis) : axis) + Vec3::Zero();
  return frame_about(z);
}

std::vector<ParallelPlane> planes_across(const BoundedInput& input, const Vec3& direction) {
  std::vector<ParallelPlane> planes;
  for (int h = 0; h < static_cast<int>(input.surfaces.halfspaces.size()); ++h) {
    const Surface& surface = input.surfaces.halfspaces[h].surface;
    if (surface.kind != SurfaceKind::Plane) continue;
    const double cosine = surface.axis.dot(direction);
    if (std::abs(std::abs(cosine) - 1) > kParallel) continue;
    ParallelPlane plane;
    plane.height = cosine > 0 ? surface.offset : -surface.offset;
    plane.halfspace = h;
    for (const int g : groups_on(input.surfaces, h)) {
      const FaceGroup& group = input.segmentation.groups[g];
      // The group's side is measured against its own surface, not the halfspace's.
      const bool is_up = group.side * group.surface.axis.dot(direction) > 0;
      (is_up ? plane.faces_up : plane.faces_down) = true;
    }
    planes.push_back(plane);
  }
  std::sort(planes.begin(), planes.end(), [](const ParallelPlane& a, const ParallelPlane& b) {
    return std::pair(a.height, a.halfspace) < std::pair(b.height, b.halfspace);
  });
  return planes;
}

const ParallelPlane* plane_at(const std::vector<ParallelPlane>& planes, double height,
                              double snap) {
  const ParallelPlane* best = nullptr;
  for (const ParallelPlane& plane : planes) {
    const double distance = std::abs(plane.height - height);
    if (distance > snap || (best && distance >= std::abs(best->height - height))) continue;
    best = &plane;
  }
  return best;
}

Literal halfspace_box(const Mesh& mesh, const Vec3& normal, double offset) {
  Literal box;
  box.rotation = rotation_about(normal);
  const bool is_flipped = box.rotation.col(2).dot(normal) < 0;
  const double margin = kBeyond * mesh.diagonal();
  Vec3 lo, hi;
  for (int k = 0; k < 3; ++k) {
    Interval extent;
    for (const Vec3& p : mesh.vertices) extent.extend(box.rotation.col(k).dot(p));
    lo[k] = extent.lo - margin;
    hi[k] = extent.hi + margin;
  }
  (is_flipped ? lo : hi).z() = is_flipped ? -offset : offset;
  box.origin = lo;
  box.size = hi - lo;
  return box;
}

std::vector<int> groups_on(const SurfaceSet& surfaces, int halfspace) {
  std::vector<int> groups;
  for (int g = 0; g < static_cast<int>(surfaces.halfspace_of_group.size()); ++g) {
    if (surfaces.halfspace_of_group[g] == halfspace) groups.push_back(g);
  }
  return groups;
}

}  // namespace hewn
