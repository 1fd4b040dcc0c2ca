#pragma once
/// Text of flat OpenSCAD designs as a syntax tree.
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/io/scad_read/scad_value.h"

namespace hewn {

inline constexpr int kDeepestScad = 400;               ///< nested blocks
inline constexpr std::size_t kMostScadNodes = 400000;  ///< instantiations in one file

/// "design.scad:12:5".
std::string at_place(const std::string& source, const ScadPlace& place);

/// Understands instantiations, modules without parameters, numbers and constants with the four
/// operations, and the modifiers * % #. `source` names the text in messages.
/// Fails with: Format (not OpenSCAD), NotFound (OpenSCAD, but of the kind that has to be flattened
/// by the program itself: functions, loops, conditions, parameters), TooLarge; `where` is
/// "source:line:column".
Result<ScadDesign> parse_scad(std::string_view text, const std::string& source);

}  // namespace hewn
