#pragma once
/// OpenSCAD's primitives as literals.
#include <string>

#include "core/base/result.h"
#include "core/csg/literal.h"
#include "core/io/scad_prism.h"
#include "core/io/scad_read/scad_value.h"

namespace hewn {

/// Where a primitive stands, beside its own arguments.
struct ScadScope {
  ScadValue sides;  ///< `$fn` of the file or of a surrounding object
  /// Circles with so many explicit sides or fewer are polygons.
  int most_prism_sides = kMostPolygonSides;
};

/// cube, cylinder, prism (see scad_prism.h), sphere, polyhedron or rotate_extrude of a circle.
bool is_solid(std::string_view name);

/// The primitive in its own coordinates. Curved ones are exact; few explicit sides make a prism.
/// Fails with: Format (zero or negative sizes, missing values), NotFound (a profile that is no
/// circle, facets that do not close); `where` names the node's place in `source`.
Result<Literal> scad_solid(const ScadNode& node, const ScadScope& scope, const std::string& source);

}  // namespace hewn
