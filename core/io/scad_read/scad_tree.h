#pragma once
/// OpenSCAD designs as trees.
#include <functional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"
#include "core/io/scad_prism.h"

namespace hewn {

struct ScadReadOptions {
  /// Circles with an explicit `$fn` of so many sides or fewer are meant as polygons and become
  /// prisms; with more they are true circles.
  int most_prism_sides = kMostPolygonSides;
  int most_literals = 10'000;
  /// Renders a stretch of OpenSCAD text (hull, minkowski, text, ...) to a closed mesh. Without it
  /// such constructs are an error.
  std::function<Result<Mesh>(const std::string& text)> render = {};
};

/// The design's solid: flat `.scad` and flattened `.csg`. Primitives with named and positional
/// arguments under translate, rotate, scale, mirror, multmatrix, union, difference, intersection
/// and group; modules without parameters become names. `source` names the text in messages.
///
/// Fails with: Format (not OpenSCAD, sizes of zero, modules that contain themselves), NotFound (a
/// construct that must be flattened or rendered by the program openscad), TooLarge, Cancelled, and
/// as `render`; `where` is "source:line:column".
Result<Tree> tree_from_scad(std::string_view text, const std::string& source,
                            const ScadReadOptions& options, const RunContext& run);

}  // namespace hewn
