#include "ui/panels/tree_marks.h"

#include "core/session/describe.h"

namespace hewn {

std::string node_text(const Tree& tree, int index) {
  const Node& node = tree.nodes[index];
  const bool is_leaf = node.op == Op::Literal;
  const std::string text =
      is_leaf ? describe_literal(tree.literals[node.literal]) : name_of(node.op);
  return node.name.empty() ? text : node.name + ": " + text;
}

bool is_marked(const Ui& ui, const Tree& tree, int index) {
  const Node& node = tree.nodes[index];
  if (node.op != Op::Literal) {
    return ui.state.picked_node == index || ui.state.hovered_node == index;
  }
  return ui.state.picked_literal == node.literal || ui.state.hovered_literal == node.literal;
}

void hover_node(Ui& ui, const Tree& tree, int index) {
  const Node& node = tree.nodes[index];
  ui.state.hovered_literal = node.op == Op::Literal ? node.literal : -1;
  ui.state.hovered_node = node.op == Op::Literal ? -1 : index;
}

void pick_node(Ui& ui, const Tree& tree, int index) {
  const Node& node = tree.nodes[index];
  const bool is_leaf = node.op == Op::Literal;
  const bool is_same =
      is_leaf ? ui.state.picked_literal == node.literal : ui.state.picked_node == index;
  ui.state.picked_literal = is_leaf && !is_same ? node.literal : -1;
  ui.state.picked_node = !is_leaf && !is_same ? index : -1;
}

void hover_nothing(StudioState& state) { state.hovered_literal = state.hovered_node = -1; }

}  // namespace hewn
