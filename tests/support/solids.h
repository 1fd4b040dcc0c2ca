#pragma once
/// Closed, outward-oriented meshes of simple solids, whose true surfaces the tests know. Vertices
/// lie on the true surface up to rounding (the tessellations are inscribed).
#include <vector>

#include "core/mesh/mesh.h"

namespace hewn::solids {

/// The box [lo, hi]; every side is a grid of `cells` x `cells` squares.
Mesh box(const Vec3& lo, const Vec3& hi, int cells = 1);

/// The solid swept by turning a polyline of (radius, z) points about the z axis. An open profile
/// begins and ends on the axis (radius 0); a closed one (first point not repeated) stays off it.
/// Seen with the radius to the right and z upwards it runs counter-clockwise. Requires: sides >= 3.
Mesh revolve(const std::vector<Vec2>& profile, int sides, bool is_closed = false);

/// A cylinder around z from z = 0 to `height`; the flank is cut into `rings` bands.
Mesh cylinder(double radius, double height, int sides, int rings = 1);

/// A frustum around z from `radius` at z = 0 to `top_radius` at `height`; 0 gives an apex.
Mesh cone(double radius, double top_radius, double height, int sides, int rings = 1);

/// A sphere around the origin with `rings` bands of latitude.
Mesh sphere(double radius, int sides, int rings);

/// A torus around z at the origin.
Mesh torus(double major_radius, double radius, int sides, int tube_sides);

/// A cylinder between two spherical caps; its parts join smoothly. `rings` bands per cap.
Mesh capsule(double radius, double height, int sides, int rings);

/// The plate [-size/2, size/2] with a round hole through its middle along z.
/// Requires: `sides` divisible by 4, hole smaller than the plate.
Mesh plate_with_hole(const Vec3& size, double hole_radius, int sides, int rings = 1);

/// A block [0, size] whose edge at x = size.x, y = size.y is rounded by a quarter cylinder of
/// `radius` in `steps` strips along z.
Mesh block_with_fillet(const Vec3& size, double radius, int steps);

/// The mesh moved by a transform that keeps the orientation.
Mesh transformed(const Mesh& mesh, const Affine3& transform);

/// Both meshes in one, not joined.
Mesh together(const Mesh& a, const Mesh& b);

/// Whether every edge has exactly two triangles that run along it in opposite directions.
bool is_closed(const Mesh& mesh);

/// A rotation that is not along any coordinate direction, with a shift.
Affine3 oblique_transform();

}  // namespace hewn::solids
