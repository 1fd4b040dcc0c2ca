#pragma once
/// Values of OpenSCAD expressions and the syntax tree of a design.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/math.h"

namespace hewn {

/// A place in the text; both count from 1.
struct ScadPlace {
  int line = 1;
  int column = 1;
  std::size_t offset = 0;  ///< bytes from the start
};

/// A number, vector, truth value, string or nothing (`undef`).
struct ScadValue {
  std::variant<std::monostate, double, bool, std::string, std::vector<ScadValue>> data;

  const double* number() const { return std::get_if<double>(&data); }
  const bool* truth() const { return std::get_if<bool>(&data); }
  const std::vector<ScadValue>* list() const { return std::get_if<std::vector<ScadValue>>(&data); }
  bool is_undefined() const { return std::holds_alternative<std::monostate>(data); }
  /// Two or three numbers; the third is then `missing`.
  std::optional<Vec3> vector(double missing = 0) const;
};

struct ScadArgument {
  std::string name;  ///< empty when positional
  ScadValue value;
};

/// A module's instantiation: `name(arguments) { children }`.
struct ScadNode {
  std::string name;
  std::vector<ScadArgument> arguments;
  std::vector<ScadNode> children;
  ScadPlace place;
  std::size_t end = 0;  ///< offset behind the last character

  /// The argument by name, else the positional one at `position` (-1: by name only).
  const ScadValue* argument(std::string_view name, int position = -1) const;
};

/// `module name() { children }`.
struct ScadModule {
  std::string name;
  std::vector<ScadNode> children;
  ScadPlace place;
};

/// A parsed design.
struct ScadDesign {
  std::vector<ScadNode> nodes;
  std::vector<ScadModule> modules;
  ScadValue sides;  ///< the file's `$fn`
};

}  // namespace hewn
