#pragma once
/// Short texts about groups, selections and literals, for panels and tooltips.
#include <string>
#include <vector>

#include "core/csg/tree.h"
#include "core/session/plan.h"

namespace hewn {

/// Four significant digits, no exponent between 1e-4 and 1e6: "3", "12.7", "0.08333".
std::string short_number(double value);

/// "cylinder r 3", "plane", "cone 45 deg", "torus 12 / 2", "free form".
std::string describe_group(const FaceGroup& group);

/// "3 cylinders, r 3, coaxial, 4.1 % of the area".
std::string describe_selection(const PreparedMesh& prepared, const std::vector<int>& groups);

/// "box 40 x 20 x 8", "cylinder r 3, h 8", "cone r 3 to 1, h 2", "sphere r 4", "torus 12 / 2".
std::string describe_literal(const Literal& literal);

}  // namespace hewn
