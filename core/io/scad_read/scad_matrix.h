#pragma once
/// OpenSCAD's transformations as affine maps.
#include <string>

#include "core/base/result.h"
#include "core/io/scad_read/scad_value.h"

namespace hewn {

/// translate, rotate, scale, mirror or multmatrix.
bool is_transformation(std::string_view name);

/// The node's map; angles that are multiples of 90 degrees give exact zeros and ones, as in
/// OpenSCAD. Fails with: Format (missing or odd arguments, a map that flattens); `where` names the
/// node's place in `source`.
Result<Affine3> scad_transformation(const ScadNode& node, const std::string& source);

}  // namespace hewn
