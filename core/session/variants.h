#pragma once
/// The same plan with other settings of the search, so that there is a choice of trees.
#include <string>
#include <vector>

#include "core/session/project.h"

namespace hewn {

struct Variant {
  std::string name;  ///< what differs: "8 starts", "beam of 2"
  Project project;   ///< without edits of literals: other trees have other literals
};

/// Cheaper and dearer searches. All different; none is the plan's own unless its settings are.
std::vector<Variant> search_variants(const Project& plan);

}  // namespace hewn
