#pragma once
/// Questions about single nodes of a tree.
#include <vector>

#include "core/csg/tree.h"

namespace hewn {

/// Indices of the literals below a node, in the order of the leaves.
std::vector<int> literals_below(const Tree& tree, int node);

}  // namespace hewn
