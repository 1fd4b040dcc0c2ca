#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ui/panels/tree_marks.h"
#include "ui/panels/widgets.h"
#include "ui/view/tree_layout.h"

namespace hewn {
namespace {

constexpr float kLeastZoom = 0.15F, kMostZoom = 3;
/// Texts smaller than this many pixels are left out: the colours remain.
constexpr float kReadable_px = 6;

/// An operation is its sign, and the name of its partition.
std::string graph_text(const Tree& tree, int index) {
  const Node& node = tree.nodes[index];
  if (node.op == Op::Literal) return node_text(tree, index);
  const char* sign = node.op == Op::Complement ? "not" : op_sign(node.op);
  return node.name.empty() ? sign : std::string(sign) + "  " + node.name;
}

std::vector<float> node_widths(const Ui& ui, const Tree& tree) {
  std::vector<float> widths;
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    const bool is_leaf = tree.nodes[n].op == Op::Literal;
    const float text = ImGui::CalcTextSize(graph_text(tree, static_cast<int>(n)).c_str()).x;
    widths.push_back(text + ui.px(is_leaf ? 24 : 16));
  }
  return widths;
}

/// The middle of the panel's left edge, and the way from the graph's coordinates to it: what is in
/// the middle stays there when the inspector takes a part of the panel.
struct Canvas {
  ImVec2 at;
  float zoom = 1, pan_x = 0, pan_y = 0;
  ImVec2 to_pixel(float x, float y) const {
    return {at.x + pan_x + x * zoom, at.y + pan_y + y * zoom};
  }
};

void fit(const Ui& ui, GraphState& state, const GraphLayout& graph, const ImVec2& size) {
  const float margin = ui.px(8);
  const float across = (size.x - 2 * margin) / std::max(graph.width, 1.0F);
  const float down = (size.y - 2 * margin) / std::max(graph.height, 1.0F);
  // Never larger than life, and never too small to be read: the rest is reached by a drag.
  state.zoom = std::clamp(std::min(across, down), 0.6F, 1.0F);
  state.pan_x = margin;
  const bool is_whole = graph.height * state.zoom <= size.y;
  const float middle = is_whole || graph.nodes.empty() ? graph.height / 2 : graph.nodes[0].y;
  state.pan_y = -middle * state.zoom;
  state.wants_fit = false;
}

/// Wheel and drag. True while the graph is dragged.
bool follow_mouse(GraphState& state, const Canvas& canvas, bool is_hovered, bool is_over_node) {
  const ImGuiIO& io = ImGui::GetIO();
  if (is_hovered && io.MouseWheel != 0) {
    const float next =
        std::clamp(state.zoom * std::pow(1.15F, io.MouseWheel), kLeastZoom, kMostZoom);
    const float x = io.MousePos.x - canvas.at.x;
    const float y = io.MousePos.y - canvas.at.y;
    state.pan_x = x - (x - state.pan_x) * next / state.zoom;
    state.pan_y = y - (y - state.pan_y) * next / state.zoom;
    state.zoom = next;
  }
  for (int button = 0; button < 3; ++button) {
    const bool can_drag = button != 0 || !is_over_node;
    if (is_hovered && can_drag && ImGui::IsMouseClicked(button)) state.is_panning = true;
  }
  const bool is_down = ImGui::IsMouseDown(0) || ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2);
  state.is_panning = state.is_panning && is_down;
  if (state.is_panning) {
    state.pan_x += io.MouseDelta.x;
    state.pan_y += io.MouseDelta.y;
  }
  if (is_hovered && !is_over_node && ImGui::IsMouseDoubleClicked(0)) state.wants_fit = true;
  return state.is_panning;
}

void draw_edge(const Ui& ui, const Tree& tree, const GraphLayout& graph, const GraphNode& node,
               const Canvas& canvas) {
  if (node.parent < 0) return;
  const GraphNode& parent = graph.nodes[node.parent];
  const float middle = GraphSpacing{}.height * ui.scale / 2;
  const ImVec2 from = canvas.to_pixel(parent.x + parent.width, parent.y + middle);
  const ImVec2 to = canvas.to_pixel(node.x, node.y + middle);
  const Op op = tree.nodes[parent.node].op;
  // The first operand is what is worked on.
  ImVec4 colour = node.place == 0 && op == Op::Difference ? ui.theme.faint : op_colour(op);
  colour.w = 0.8F;
  const float bend = (to.x - from.x) / 2;
  ImGui::GetWindowDrawList()->AddBezierCubic(from, {from.x + bend, from.y}, {to.x - bend, to.y}, to,
                                             ImGui::GetColorU32(colour), 1.5F * ui.scale);
}

void draw_box(const Ui& ui, const Tree& tree, const GraphNode& node, const Canvas& canvas) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Node& here = tree.nodes[node.node];
  const bool is_leaf = here.op == Op::Literal;
  const float height = GraphSpacing{}.height * ui.scale;
  const ImVec2 lo = canvas.to_pixel(node.x, node.y);
  const ImVec2 hi = canvas.to_pixel(node.x + node.width, node.y + height);
  const bool is_hot = is_marked(ui, tree, node.node);
  const float round = ui.px(4) * canvas.zoom;
  ImVec4 fill = is_leaf ? ui.theme.raised : op_colour(here.op);
  if (!is_leaf) fill.w = 0.22F;
  list.AddRectFilled(lo, hi, ImGui::GetColorU32(ui.theme.panel), round);
  list.AddRectFilled(lo, hi, ImGui::GetColorU32(fill), round);
  const ImVec4 rim = is_hot ? ui.theme.accent : (is_leaf ? ui.theme.line : op_colour(here.op));
  list.AddRect(lo, hi, ImGui::GetColorU32(rim), round, 0, (is_hot ? 2.0F : 1.0F) * ui.scale);
  float x = lo.x + ui.px(8) * canvas.zoom;
  if (is_leaf) {
    const ImU32 colour = ImGui::GetColorU32(to_colour(golden_state(here.literal)));
    list.AddCircleFilled({x + ui.px(2) * canvas.zoom, (lo.y + hi.y) / 2}, ui.px(4) * canvas.zoom,
                         colour);
    x += ui.px(10) * canvas.zoom;
  }
  const float size = ImGui::GetFontSize() * canvas.zoom;
  if (size < kReadable_px) return;
  list.AddText(ImGui::GetFont(), size, {x, (lo.y + hi.y - size) / 2},
               ImGui::GetColorU32(ui.theme.text), graph_text(tree, node.node).c_str());
}

/// Whether the box itself says what a tooltip would.
bool is_readable(const Tree& tree, const GraphNode& node, const Canvas& canvas) {
  return tree.nodes[node.node].op == Op::Literal &&
         ImGui::GetFontSize() * canvas.zoom >= kReadable_px;
}

}  // namespace

void draw_graph(Ui& ui, const Tree& tree) {
  ImGui::PushFont(ui.fonts.small);
  const GraphSpacing plain;
  const GraphSpacing spacing{plain.height * ui.scale, plain.pitch * ui.scale,
                             plain.gap_x * ui.scale, plain.gap_y * ui.scale};
  const GraphLayout graph = layout_tree(tree, node_widths(ui, tree), spacing);
  GraphState& state = ui.state.graph;
  const ImVec2 size = ImGui::GetContentRegionAvail();
  if (size.x < 1 || size.y < 1) return ImGui::PopFont();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (state.wants_fit) fit(ui, state, graph, size);
  const Canvas canvas{{at.x, at.y + size.y / 2}, state.zoom, state.pan_x, state.pan_y};
  ImGui::InvisibleButton("canvas", size);
  const bool is_hovered = ImGui::IsItemHovered();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const GraphNode* over = nullptr;
  for (const GraphNode& node : graph.nodes) {
    const ImVec2 lo = canvas.to_pixel(node.x, node.y);
    const ImVec2 hi = canvas.to_pixel(node.x + node.width, node.y + spacing.height);
    const bool is_in = mouse.x >= lo.x && mouse.x < hi.x && mouse.y >= lo.y && mouse.y < hi.y;
    if (is_hovered && is_in) over = &node;
  }
  const bool is_dragged = follow_mouse(state, canvas, is_hovered, over != nullptr);
  if (over && !is_dragged) {
    hover_node(ui, tree, over->node);
    if (ImGui::IsMouseClicked(0)) pick_node(ui, tree, over->node);
    if (!is_readable(tree, *over, canvas)) {
      ImGui::SetTooltip("%s", node_text(tree, over->node).c_str());
    }
  }
  ImGui::PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
  for (const GraphNode& node : graph.nodes) draw_edge(ui, tree, graph, node, canvas);
  for (const GraphNode& node : graph.nodes) draw_box(ui, tree, node, canvas);
  ImGui::PopClipRect();
  ImGui::PopFont();
}

}  // namespace hewn
