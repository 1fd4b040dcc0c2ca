/// Cuboids from pairs of parallel planes. Where the reference searches with a genetic algorithm,
/// every planar face spans a rectangle here, and each opposite plane gives it a depth.
#include <algorithm>
#include <array>

#include "core/fit/bounded_parts.h"

namespace hewn {
namespace {

constexpr double kOrthogonal = 1e-9;

/// A direction with the planes across it.
struct Axis {
  Vec3 direction;
  std::vector<ParallelPlane> planes;
};

/// A box in the making: one interval for each of three axes, and the planes at their ends.
struct Draft {
  std::array<Vec3, 3> axes;
  std::array<Interval, 3> sides;
  std::vector<int> halfspaces;

  /// Moves both ends of side k onto planes where these are close.
  void snap(int k, const std::vector<ParallelPlane>& planes, double tolerance) {
    for (double* end : {&sides[k].lo, &sides[k].hi}) {
      const ParallelPlane* plane = plane_at(planes, *end, tolerance);
      if (!plane) continue;
      *end = plane->height;
      halfspaces.push_back(plane->halfspace);
    }
  }
};

class CuboidMaker {
 public:
  CuboidMaker(const BoundedInput& input, std::vector<BoundedPrimitive>& out)
      : input_(input), out_(out) {
    for (const Vec3& direction : input.surfaces.directions) {
      axes_.push_back({direction, planes_across(input, direction)});
    }
  }

  void from_group(int g) {
    const int h = input_.surfaces.halfspace_of_group[g];
    if (h < 0 || input_.surfaces.halfspaces[h].surface.kind != SurfaceKind::Plane) return;
    const int depth_axis = input_.surfaces.halfspaces[h].direction;
    if (depth_axis < 0) return;
    for (int j = 0; j < static_cast<int>(axes_.size()); ++j) {
      const double cosine = axes_[j].direction.dot(axes_[depth_axis].direction);
      if (std::abs(cosine) > kOrthogonal || axes_[j].planes.size() < 2) continue;
      const Vec3 third = axes_[depth_axis].direction.cross(axes_[j].direction);
      // Each frame once: the third direction must not be a later one of the set.
      const int k = index_of(third);
      if (k >= 0 && k < j) continue;
      from_frame(g, depth_axis, j, third);
    }
  }

 private:
  int index_of(const Vec3& direction) const {
    for (int k = 0; k < static_cast<int>(axes_.size()); ++k) {
      if (std::abs(std::abs(axes_[k].direction.dot(direction)) - 1) < kOrthogonal) return k;
    }
    return -1;
  }

  void from_frame(int g, int depth_axis, int width_axis, const Vec3& third) {
    const FaceGroup& group = input_.segmentation.groups[g];
    const Axis& depth = axes_[depth_axis];
    Draft face;
    face.axes = {depth.direction, axes_[width_axis].direction, third};
    for (int k = 1; k < 3; ++k) {
      face.sides[k] = extent_along(input_.mesh, group.triangles, face.axes[k]);
    }
    face.snap(1, axes_[width_axis].planes, input_.snap);
    face.snap(2, planes_across(input_, third), input_.snap);
    const ParallelPlane* base = find_plane(depth.planes, input_.surfaces.halfspace_of_group[g]);
    if (!base) return;
    const bool is_up = group.side * group.surface.axis.dot(depth.direction) > 0;
    for (const ParallelPlane& other : depth.planes) {
      // Opposite sides of a boss or of a pocket look away from each other.
      const bool is_opposite = is_up ? other.faces_down : other.faces_up;
      if (!is_opposite || other.halfspace == base->halfspace) continue;
      Draft box = face;
      box.sides[0] = {std::min(base->height, other.height), std::max(base->height, other.height)};
      box.halfspaces.push_back(base->halfspace);
      box.halfspaces.push_back(other.halfspace);
      finish(g, std::move(box));
    }
  }

  static const ParallelPlane* find_plane(const std::vector<ParallelPlane>& planes, int halfspace) {
    const auto found = std::find_if(planes.begin(), planes.end(), [&](const ParallelPlane& plane) {
      return plane.halfspace == halfspace;
    });
    return found == planes.end() ? nullptr : &*found;
  }

  void finish(int g, Draft box) {
    std::sort(box.halfspaces.begin(), box.halfspaces.end());
    box.halfspaces.erase(std::unique(box.halfspaces.begin(), box.halfspaces.end()),
                         box.halfspaces.end());
    if (static_cast<int>(box.halfspaces.size()) < input_.min_sides) return;
    BoundedPrimitive primitive;
    primitive.kind = BoundedKind::Cuboid;
    Literal& literal = primitive.literal;
    literal.rotation = rotation_of(box.axes[0], box.axes[1], box.axes[2]);
    for (int k = 0; k < 3; ++k) {
      // Which column this axis became, and whether it was turned round.
      const Vec3 cosines = literal.rotation.transpose() * box.axes[k];
      int column = 0;
      cosines.cwiseAbs().maxCoeff(&column);
      literal.origin[column] = cosines[column] > 0 ? box.sides[k].lo : -box.sides[k].hi;
      literal.size[column] = box.sides[k].length();
    }
    if (!(literal.size.minCoeff() > input_.snap)) return;
    primitive.groups = {g};
    primitive.halfspaces = std::move(box.halfspaces);
    out_.push_back(std::move(primitive));
  }

  const BoundedInput& input_;
  std::vector<BoundedPrimitive>& out_;
  std::vector<Axis> axes_;
};

}  // namespace

void add_cuboids(const BoundedInput& input, const RunContext& run,
                 std::vector<BoundedPrimitive>& out) {
  CuboidMaker maker(input, out);
  for (int g = 0; g < static_cast<int>(input.segmentation.groups.size()); ++g) {
    if (run.is_cancelled()) return;
    maker.from_group(g);
  }
}

}  // namespace hewn
