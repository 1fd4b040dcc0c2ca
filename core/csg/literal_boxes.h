#pragma once
/// Where each literal of a tree can matter.
#include <vector>

#include "core/csg/tree.h"

namespace hewn {

/// For each literal, what of its box lies in the solid's; empty when nothing does.
std::vector<Box3> literal_boxes(const Tree& tree);

}  // namespace hewn
