#pragma once
/// Distances and angles between places of the mesh, as a person measures a part.
#include <optional>
#include <string>
#include <vector>

#include "core/session/plan.h"

namespace hewn {

/// A vertex between face groups.
struct Corner {
  Vec3 at = Vec3::Zero();
  std::vector<int> groups;  ///< ascending, two at least
};

/// All of a mesh. Cost: O(n), and O(k log k) for k corners.
std::vector<Corner> corners_of(const PreparedMesh& prepared);

/// A place of the mesh that was pointed at.
struct Spot {
  Vec3 at = Vec3::Zero();
  int group = -1;
  /// It is a corner and meant itself; else the surface of its group is.
  bool is_corner = false;
};

/// How a place is pointed at: along a ray, at what is seen of a face group.
struct Pointing {
  Vec3 origin, direction;  ///< model coordinates; the direction is unit
  int group = -1;
  /// What lies beyond this plane is not seen: points with normal . x > offset.
  Vec3 cut_normal = Vec3::Zero();
  double cut_offset = kInfinity;
};

/// The place that a ray meets; nothing when it misses the group. Cost: a few ray casts.
std::optional<Spot> spot_at(const PreparedMesh& prepared, const Pointing& pointing);

/// A number and where a line in the part shows it.
struct Dimension {
  std::string what;  ///< "radius", "planes", "axis to plane"
  double value = 0;  ///< model units, or degrees
  bool is_angle = false;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< on the first and the second; equal: no line
};

/// The sizes of the surface that a spot stands for, then its coordinates "x", "y" and "z".
std::vector<Dimension> dimensions_of(const PreparedMesh& prepared, const Spot& spot);

/// First what lies between the two: the distance of points, axes (of cylinders, cones and tori),
/// centres (of spheres) and planes, or the angle of those that are not parallel (to 1e-3 rad). Then
/// the distance of the spots themselves where it is another, and its parts "x", "y" and "z". Of one
/// face, the spots alone.
std::vector<Dimension> dimensions_between(const PreparedMesh& prepared, const Spot& a,
                                          const Spot& b);

}  // namespace hewn
