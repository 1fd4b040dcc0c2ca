#pragma once
/// Module names: valid in OpenSCAD and different from each other.
#include <set>
#include <string>

namespace hewn {

class ModuleNames {
 public:
  /// `wish` with foreign characters replaced, a prefix where it would be a keyword or start with a
  /// digit, and a number where the name is taken.
  std::string unique(const std::string& wish);

 private:
  std::set<std::string> taken_;
};

}  // namespace hewn
