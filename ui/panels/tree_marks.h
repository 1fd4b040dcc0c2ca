#pragma once
/// What outline and graph share: texts of nodes, and the one selection.
#include <string>

#include "core/csg/tree.h"
#include "ui/studio_state.h"

namespace hewn {

/// "body: union", "cylinder r 3, h 20".
std::string node_text(const Tree& tree, int node);

/// Whether the node is picked or pointed at, here or in the view.
bool is_marked(const Ui& ui, const Tree& tree, int node);

/// The mouse is over the node: what lies below it is highlighted.
void hover_node(Ui& ui, const Tree& tree, int node);

/// A click: picks the node, or gives it up when it is picked already.
void pick_node(Ui& ui, const Tree& tree, int node);

/// Nothing in a list is under the mouse.
void hover_nothing(StudioState& state);

}  // namespace hewn
