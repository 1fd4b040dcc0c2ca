#pragma once
/// The makers of each kind of bounded primitive and what they share. Internal to `bounded.cpp`.
#include <span>
#include <vector>

#include "core/fit/bounded.h"

namespace hewn {

/// What all makers read.
struct BoundedInput {
  const Mesh& mesh;
  const Segmentation& segmentation;
  const SurfaceSet& surfaces;
  double snap = 0;  ///< model units
  int min_sides = 4;
};

struct Interval {
  double lo = kInfinity;
  double hi = -kInfinity;

  void extend(double x) {
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
  double length() const { return hi - lo; }
};

/// The part of a line that the vertices of triangles cover, in lengths of the unit `direction`.
Interval extent_along(const Mesh& mesh, std::span<const int> triangles, const Vec3& direction);

/// A right-handed rotation whose columns are, up to order and sign, three orthonormal directions:
/// the one closest to the identity, so that equal frames give equal rotations.
Mat3 rotation_of(const Vec3& a, const Vec3& b, const Vec3& c);

/// A rotation whose z axis is `axis` up to sign. Frames along coordinate axes are permutations.
Mat3 rotation_about(const Vec3& axis);

/// Planes of the surface set across a direction.
struct ParallelPlane {
  double height = 0;  ///< along the direction
  int halfspace = -1;
  bool faces_up = false;    ///< some group's outward normal points along the direction
  bool faces_down = false;  ///< or against it
};

/// All planes whose normal is parallel to `direction`, by height.
std::vector<ParallelPlane> planes_across(const BoundedInput& input, const Vec3& direction);

/// The plane closest to a height, at most `snap` away; null for none.
const ParallelPlane* plane_at(const std::vector<ParallelPlane>& planes, double height, double snap);

/// The box over the whole mesh that ends at the plane `normal . x = offset` and lies behind it.
Literal halfspace_box(const Mesh& mesh, const Vec3& normal, double offset);

/// Indices of groups on a halfspace, ascending.
std::vector<int> groups_on(const SurfaceSet& surfaces, int halfspace);

void add_round_solids(const BoundedInput& input, std::vector<BoundedPrimitive>& out);
void add_cuboids(const BoundedInput& input, const RunContext& run,
                 std::vector<BoundedPrimitive>& out);
void add_fillets(const BoundedInput& input, std::vector<BoundedPrimitive>& out);
void add_extra_planes(const BoundedInput& input, std::vector<BoundedPrimitive>& out);

}  // namespace hewn
