#pragma once
/// The regular prism in OpenSCAD, which has none that keeps its sides apart from the resolution of
/// circles.
#include <string_view>

namespace hewn {

/// Circles with so many explicit sides or fewer are polygons, those with more are meant to be
/// round.
inline constexpr int kMostPolygonSides = 8;

/// Written before the design; read back as `SolidKind::Prism` where the text is the same.
inline constexpr std::string_view kPrismModule =
    "module prism(sides, r, h) {\n"
    "  corner = r / cos(180 / sides);\n"
    "  linear_extrude(height = h)\n"
    "    polygon([for (k = [0 : sides - 1])\n"
    "      corner * [cos(360 * k / sides), sin(360 * k / sides)]]);\n"
    "}\n";

}  // namespace hewn
