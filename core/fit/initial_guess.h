#pragma once
/// First guesses of curved surfaces from a patch of points and facet normals.
#include <span>
#include <vector>

#include "core/csg/surface.h"

namespace hewn {

/// A small connected patch: its vertices, and one normal and centre per flat facet.
struct Patch {
  std::span<const Vec3> points;
  std::span<const Vec3> normals;
  std::span<const Vec3> centers;
};

/// Closed-form guesses of every curved kind that the patch can tell: a cylinder (the direction
/// least present in the normals, and a circle across it), a sphere (linear least squares), a cone
/// (normals about their mean, apex from the tangent planes) and two tori (the axis that all normal
/// lines meet: a linear line complex). Implausible ones are left out; refine the rest with
/// `refine_surface`. `size` is the length against which radii are judged (the mesh's diagonal).
std::vector<Surface> guess_surfaces(const Patch& patch, double size);

}  // namespace hewn
