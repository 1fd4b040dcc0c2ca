#include <cmath>
#include <string>

#include "core/session/describe.h"
#include "ui/panels/tree_marks.h"
#include "ui/panels/widgets.h"

namespace hewn {
namespace {

/// What stands left of a child: the operation of its parent; the first is what is worked on.
struct Place {
  Op op = Op::Union;
  bool is_first = true;
};

/// The row's sign, colour and text, on top of the row.
void draw_row(const Ui& ui, const Tree& tree, int index, const Place& place) {
  const Node& node = tree.nodes[index];
  if (!place.is_first) {
    ImGui::PushStyleColor(ImGuiCol_Text, op_colour(place.op));
    ImGui::TextUnformatted(op_sign(place.op));
    ImGui::PopStyleColor();
  } else {
    ImGui::Dummy({1, 1});
  }
  // The signs have a column of their own, so that operands of one operation stand in line.
  ImGui::SameLine(0, 0);
  const float sign = ImGui::CalcTextSize(place.is_first ? "" : op_sign(place.op)).x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() - (place.is_first ? 1 : sign) + ui.px(14));
  if (node.op == Op::Literal) {
    const float y = ImGui::GetCursorPosY();
    ImGui::SetCursorPosY(y + ImGui::GetStyle().FramePadding.y);  // as the texts are
    dot(ui, to_colour(golden_state(node.literal)));
    ImGui::SameLine(0, ui.px(4));
    ImGui::SetCursorPosY(y);
  }
  ImGui::TextUnformatted(node_text(tree, index).c_str());
}

void draw_node(Ui& ui, const Tree& tree, int index, const Place& place) {
  const Node& node = tree.nodes[index];
  ImGui::PushID(index);
  const bool is_leaf = node.op == Op::Literal;
  const ImGuiTreeNodeFlags flags =
      ImGuiTreeNodeFlags_DefaultOpen | ImGuiTreeNodeFlags_OpenOnArrow |
      ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_FramePadding |
      (is_leaf ? ImGuiTreeNodeFlags_Leaf | ImGuiTreeNodeFlags_NoTreePushOnOpen : 0) |
      (is_marked(ui, tree, index) ? ImGuiTreeNodeFlags_Selected : 0);
  const float x = ImGui::GetCursorPosX();
  const bool is_open = ImGui::TreeNodeEx("##node", flags);
  if (ImGui::IsItemHovered()) hover_node(ui, tree, index);
  if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen()) pick_node(ui, tree, index);
  ImGui::SameLine(x + ui.px(is_leaf ? 4 : 22));
  draw_row(ui, tree, index, place);
  if (is_open && !is_leaf) {
    bool is_first = true;
    for (const int child : node.children) {
      draw_node(ui, tree, child, {node.op, is_first});
      is_first = false;
    }
    ImGui::TreePop();
  }
  ImGui::PopID();
}

}  // namespace

void draw_outline(Ui& ui, const Tree& tree) {
  // Chains of differences and unions go deep.
  ImGui::PushStyleVar(ImGuiStyleVar_IndentSpacing, ui.px(10));
  // No gaps between the rows, where a click would do nothing.
  const ImGuiStyle& style = ImGui::GetStyle();
  const ImVec2 spacing = style.ItemSpacing;
  const float padding = std::floor(spacing.y / 2);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {style.FramePadding.x, padding});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {spacing.x, spacing.y - 2 * padding});
  draw_node(ui, tree, tree.root, {});
  ImGui::PopStyleVar(3);
}

}  // namespace hewn
