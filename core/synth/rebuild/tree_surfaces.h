#pragma once
/// The halfspaces behind the faces of bounded literals.
#include <optional>
#include <vector>

#include "core/csg/literal.h"
#include "core/fit/surface_set.h"

namespace hewn {

/// Halfspaces of a set of literals, each once, with shared directions.
struct TreeSurfaces {
  SurfaceSet all;  ///< exact: tolerance 0, no face groups
  std::vector<std::vector<int>> of_literal;

  /// The literal's halfspace whose surface is nearest to `p`.
  int nearest(int literal, const Vec3& p) const;
};

/// Nothing when a literal is no intersection of halfspaces: a polyhedron or a stretched solid.
/// Parallel and equal surfaces are recognised up to rounding (1e-9 of `scale`).
std::optional<TreeSurfaces> surfaces_of(const std::vector<Literal>& literals, double scale);

}  // namespace hewn
