#pragma once
/// Where the nodes of a tree stand in its graph: the root at the left, operands to the right of
/// their operation, from top to bottom in their order.
#include <span>
#include <vector>

#include "core/csg/tree.h"

namespace hewn {

struct GraphNode {
  int node = -1;    ///< of the tree
  int parent = -1;  ///< index into `GraphLayout::nodes`; -1: the root
  int place = 0;    ///< among its parent's operands
  int column = 0;
  float x = 0, y = 0, width = 0;  ///< left edge, top edge
};

struct GraphLayout {
  std::vector<GraphNode> nodes;  ///< parents before their children
  float width = 0, height = 0;   ///< of everything, from (0, 0)
};

struct GraphSpacing {
  float height = 22;  ///< of a node
  float pitch = 40;   ///< of the columns
  float gap_x = 14;   ///< from a node to the column of its operands, at least
  float gap_y = 6;    ///< between nodes
};

/// A tidy drawing (Reingold and Tilford 1981): a parent stands amid its operands, which begin in
/// one column right of it; subtrees move as close together as their outlines allow, and nothing
/// overlaps. Wide nodes reach over several columns, so that long texts of leaves push nothing away.
/// `widths`: one for each node of the tree. Cost: O(nodes x columns).
GraphLayout layout_tree(const Tree& tree, std::span<const float> widths,
                        const GraphSpacing& spacing);

}  // namespace hewn
