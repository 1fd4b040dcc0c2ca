#include "core/io/scad_names.h"

#include <algorithm>
#include <string_view>

namespace hewn {
namespace {

constexpr std::string_view kReserved[] = {"module",
                                          "function",
                                          "if",
                                          "else",
                                          "for",
                                          "intersection_for",
                                          "let",
                                          "assert",
                                          "echo",
                                          "each",
                                          "true",
                                          "false",
                                          "undef",
                                          "include",
                                          "use",
                                          "union",
                                          "difference",
                                          "intersection",
                                          "translate",
                                          "rotate",
                                          "scale",
                                          "mirror",
                                          "multmatrix",
                                          "color",
                                          "hull",
                                          "minkowski",
                                          "offset",
                                          "resize",
                                          "cube",
                                          "sphere",
                                          "cylinder",
                                          "prism",
                                          "polyhedron",
                                          "circle",
                                          "square",
                                          "polygon",
                                          "text",
                                          "import",
                                          "surface",
                                          "projection",
                                          "render",
                                          "children",
                                          "group",
                                          "linear_extrude",
                                          "rotate_extrude"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::string ModuleNames::unique(const std::string& wish) {
  std::string name;
  for (const char c : wish) {
    const char valid = is_letter(c) || is_digit(c) ? c : '_';
    // A run of foreign characters (or one character of several bytes) becomes one underscore.
    if (valid == '_' && !name.empty() && name.back() == '_') continue;
    name += valid;
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  const bool is_reserved =
      std::find(std::begin(kReserved), std::end(kReserved), name) != std::end(kReserved);
  if (name.empty()) name = "part";
  if (is_reserved || is_digit(name.front())) name = "part_" + name;
  std::string candidate = name;
  for (int n = 2; !taken_.insert(candidate).second; ++n) candidate = name + "_" + std::to_string(n);
  return candidate;
}

}  // namespace hewn
