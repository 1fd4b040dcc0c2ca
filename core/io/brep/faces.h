#pragma once
/// The triangles of a boundary representation's faces.
#include "core/io/brep/module.h"

namespace hewn {

/// See `BrepFunctions::triangulate`.
Result<TriangleSoup> triangulate_brep(const BrepInput& input, BooleanStrategy strategy,
                                      double angle_deg, double deflection, const RunContext& run);

}  // namespace hewn
