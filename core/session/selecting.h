#pragma once
/// Completing a selection of face groups. Selections are ascending lists without repetitions.
#include <string>
#include <vector>

#include "core/session/document.h"

namespace hewn {

/// What "similar" asks for beside the same kind of surface on the same side.
enum class Likeness { Kind, Radius, Parallel, Coaxial };

/// All groups that resemble one of the selected. Tolerances: 1e-3 rad and 1e-4 of the diagonal.
std::vector<int> select_like(const PreparedMesh& prepared, const std::vector<int>& selected,
                             Likeness likeness);

/// With the neighbours of the selected groups. Cost: O(n log n).
std::vector<int> grown(const PreparedMesh& prepared, const std::vector<int>& selected);

/// Without those that have a neighbour outside. Cost: O(n log n).
std::vector<int> shrunk(const PreparedMesh& prepared, const std::vector<int>& selected);

/// The union, difference or exchange of two selections.
enum class Combine { Replace, Add, Remove, Toggle };
std::vector<int> combined(const std::vector<int>& selected, const std::vector<int>& picked,
                          Combine how);

/// A plane for a cut, drawn freely and moved to what it nearly meets.
struct SnappedPlane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0;
  std::string snapped_to;  ///< "z axis, plane 12"; empty when nothing was near
};

/// Snaps the direction to a coordinate axis, or to the direction of a group's plane or axis, within
/// `angle_rad`; keeps `through` on the plane, then snaps the offset to planes, axes and centres
/// within `reach`.
SnappedPlane snap_plane(const PreparedMesh& prepared, const Vec3& normal, const Vec3& through,
                        double angle_rad, double reach);

}  // namespace hewn
