#pragma once
/// One literal as an OpenSCAD statement.
#include <string>

#include "core/csg/literal.h"
#include "core/io/decimal.h"
#include "core/io/scad_rotation.h"

namespace hewn {

/// What all statements of one file share.
struct ScadStyle {
  DecimalGrid grid;
  double tolerance_rad = 1e-7;  ///< directions closer than this are printed as the same
  double slack = 1e-6;          ///< how far an angle's rounding may move a point of the model
  bool match_facets = false;
  int unit_exponent = 0;  ///< printed lengths are in units of 10^unit_exponent
  double reach = 1;       ///< largest absolute coordinate
};

/// Statement for a literal aligned with `frame`, in the frame's coordinates; ends with ";" and, for
/// a polyhedron, spans lines indented by `indent`.
/// Requires: `is_aligned(literal, frame, style.tolerance_rad)`.
std::string print_aligned(const Literal& literal, const Mat3& frame, const ScadStyle& style,
                          const std::string& indent);

/// Statement for a lone cylinder or torus at any angle: moved to its base, then turned about it.
std::string print_turned(const Literal& literal, const Mat3& frame, const ScadStyle& style);

}  // namespace hewn
