#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/session/describe.h"
#include "ui/panels/widgets.h"

namespace hewn {
namespace {

void row(const Ui& ui, const char* name, const std::string& value, const std::string& full) {
  ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.faint);
  ImGui::TextUnformatted(name);
  ImGui::PopStyleColor();
  ImGui::SameLine();
  right_aligned(value);
  if (!full.empty() && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", full.c_str());
}

void draw_numbers(const Ui& ui, const FoundResult& result) {
  const TreeScore& score = result.found.score;
  const double diagonal = result.found.prepared.mesh->diagonal();
  const int literals = literal_count(result.found.tree);
  row(ui, "literals", std::to_string(literals), "Bounded primitives in the tree.");
  row(ui, "size", std::to_string(tree_size(result.found.tree)), "Literals and binary operations.");
  row(ui, "proximity", fmt::format("{:.3f}", score.proximity),
      "Share of operations whose operands touch: 1 is best.");
  row(ui, "common volume", fmt::format("{:.4f}", score.iou),
      fmt::format("Intersection over union with the mesh: {:.17g}", score.iou));
  row(ui, "mean error", short_number(score.mean_distance * diagonal),
      fmt::format("{:.6g} model units, {:.4g} % of the diagonal", score.mean_distance * diagonal,
                  100 * score.mean_distance));
  row(ui, "largest error", short_number(score.hausdorff * diagonal),
      fmt::format("{:.6g} model units, {:.4g} % of the diagonal", score.hausdorff * diagonal,
                  100 * score.hausdorff));
  row(ui, "seconds", fmt::format("{:.2f}", result.seconds), "Time of the search.");
}

/// What stands left of a child: the operation of its parent; the first is what is worked on.
struct Place {
  Op op = Op::Union;
  bool is_first = true;
};

void draw_node(Ui& ui, const Tree& tree, int index, const Place& place) {
  const Node& node = tree.nodes[index];
  ImGui::PushID(index);
  const bool is_leaf = node.op == Op::Literal;
  const bool is_hot = is_leaf && (ui.state.picked_literal == node.literal ||
                                  ui.state.hovered_literal == node.literal);
  const ImGuiTreeNodeFlags flags =
      ImGuiTreeNodeFlags_DefaultOpen | ImGuiTreeNodeFlags_OpenOnArrow |
      ImGuiTreeNodeFlags_SpanAvailWidth |
      (is_leaf ? ImGuiTreeNodeFlags_Leaf | ImGuiTreeNodeFlags_NoTreePushOnOpen : 0) |
      (is_hot ? ImGuiTreeNodeFlags_Selected : 0);
  const float x = ImGui::GetCursorPosX();
  const bool is_open = ImGui::TreeNodeEx("##node", flags);
  if (is_leaf && ImGui::IsItemHovered()) ui.state.hovered_literal = node.literal;
  if (is_leaf && ImGui::IsItemClicked()) {
    const bool is_same = ui.state.picked_literal == node.literal;
    ui.state.picked_literal = is_same ? -1 : node.literal;
  }
  ImGui::SameLine(x + ui.px(is_leaf ? 4 : 18));
  if (!place.is_first) {
    ImGui::PushStyleColor(ImGuiCol_Text, op_colour(place.op));
    ImGui::TextUnformatted(op_sign(place.op));
    ImGui::PopStyleColor();
    ImGui::SameLine(0, ui.px(8));
  }
  std::string text = is_leaf ? describe_literal(tree.literals[node.literal]) : name_of(node.op);
  if (!node.name.empty()) text = node.name + ": " + text;
  if (is_leaf) {
    dot(ui, to_colour(golden_state(node.literal)));
    ImGui::SameLine(0, ui.px(4));
  }
  ImGui::TextUnformatted(text.c_str());
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

/// One number of the picked literal; Enter makes the change.
void draw_field(Ui& ui, int literal, const LiteralField& field, double diagonal) {
  ImGui::PushID(field.name);
  ImGui::AlignTextToFramePadding();
  faint_text(ui, field.name);
  ImGui::SameLine(ui.px(104));
  double value = field.value;
  ImGui::SetNextItemWidth(ui.px(104));
  const bool is_done =
      ImGui::InputDouble("##value", &value, 0, 0, "%.6g", ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemActive()) ui.state.active_field = field.name;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%.17g model units; Enter changes it", field.value);
  const double rounder = suggested_value(field.value, diagonal);
  if (rounder != field.value) {
    ImGui::SameLine();
    if (ImGui::Button(short_number(rounder).c_str())) {
      static_cast<void>(ui.session.execute(EditLiteral{{literal, field.name, rounder}}));
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("The round value close by.");
  }
  if (is_done && value != field.value) {
    static_cast<void>(ui.session.execute(EditLiteral{{literal, field.name, value}}));
  }
  ImGui::PopID();
}

/// The numbers of the picked literal. Only a tree that belongs to the plan can be edited.
void draw_inspector(Ui& ui, const FoundResult& result) {
  const Tree& tree = result.found.tree;
  const int l = ui.state.picked_literal;
  if (l < 0 || static_cast<std::size_t>(l) >= tree.literals.size()) return;
  const Literal& literal = tree.literals[l];
  heading(ui, describe_literal(literal).c_str());
  const double diagonal = result.found.prepared.mesh->diagonal();
  const auto current = ui.session.current_result();
  ImGui::BeginDisabled(current.get() != &result);
  ImGui::PushFont(ui.fonts.small);
  for (const LiteralField& field : literal_fields(literal)) draw_field(ui, l, field, diagonal);
  ImGui::PopFont();
  ImGui::EndDisabled();
}

/// Axis limits with a margin, so that no dot sits on the frame.
struct Range {
  double lo = kInfinity, hi = -kInfinity;
  void add(double v) {
    lo = std::min(lo, v);
    hi = std::max(hi, v);
  }
  float place(double v, float from, float to) const {
    const double span = hi > lo ? hi - lo : 1;
    const double share = hi > lo ? (v - lo) / span : 0.5;
    return from + static_cast<float>(0.08 + 0.84 * share) * (to - from);
  }
};

/// Blue is exact, red is not: on a logarithmic scale of the mean error.
ImVec4 error_colour(const Ui& ui, double mean) {
  const double t = std::clamp((std::log10(std::max(mean, 1e-6)) + 5) / 3, 0.0, 1.0);
  const auto mix = static_cast<float>(t);
  const ImVec4 &a = ui.theme.accent, &b = ui.theme.bad;
  return {a.x + (b.x - a.x) * mix, a.y + (b.y - a.y) * mix, a.z + (b.z - a.z) * mix, 1};
}

/// Whether another result is at least as good in all three measures and better in one.
bool is_dominated(const FoundResult& r, const Session& session) {
  const auto values = [](const FoundResult& f) {
    return std::array<double, 3>{static_cast<double>(tree_size(f.found.tree)),
                                 -f.found.score.proximity, -f.found.score.agreement};
  };
  const auto own = values(r);
  return std::any_of(session.results().begin(), session.results().end(), [&](const auto& other) {
    const auto theirs = values(*other);
    bool is_better = false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (theirs[k] > own[k]) return false;
      is_better |= theirs[k] < own[k];
    }
    return is_better;
  });
}

void draw_pareto(Ui& ui) {
  const auto& results = ui.session.results();
  if (results.size() < 2) {
    ImGui::PushTextWrapPos();
    faint_text(ui,
               "One tree so far. \"Search variants\" looks for others with six other settings.");
    ImGui::PopTextWrapPos();
    action_button(ui, "Search variants");
    return;
  }
  Range sizes, proximities;
  for (const auto& r : results) {
    sizes.add(tree_size(r->found.tree));
    proximities.add(r->found.score.proximity);
  }
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = ui.px(180);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + width, at.y + height}, ImGui::GetColorU32(ui.theme.raised),
                     ui.px(4));
  const auto shown = ui.session.shown_result();
  ImGui::InvisibleButton("pareto", {width, height});
  const bool is_over = ImGui::IsItemHovered();
  const bool is_clicked = ImGui::IsItemClicked();  // the texts below are items, too
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  std::shared_ptr<const FoundResult> nearest;
  float best = ui.px(14);
  for (const auto& r : results) {
    const float x = sizes.place(tree_size(r->found.tree), at.x, at.x + width);
    const float y = proximities.place(r->found.score.proximity, at.y + height, at.y);
    const ImU32 colour = ImGui::GetColorU32(error_colour(ui, r->found.score.mean_distance));
    if (is_dominated(*r, ui.session)) {
      list.AddCircle({x, y}, ui.px(4), colour, 0, 1.5F);
    } else {
      list.AddCircleFilled({x, y}, ui.px(5), colour);
    }
    if (r == shown) list.AddCircle({x, y}, ui.px(9), ImGui::GetColorU32(ui.theme.text), 0, 1.5F);
    const float apart = std::hypot(mouse.x - x, mouse.y - y);
    if (!is_over || apart >= best) continue;
    best = apart;
    nearest = r;
  }
  ImGui::PushFont(ui.fonts.small);
  faint_text(ui, fmt::format("size {:.0f} to {:.0f}  \u2192", sizes.lo, sizes.hi));
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.faint);
  right_aligned(fmt::format("\u2191 proximity {:.2f} to {:.2f}", proximities.lo, proximities.hi));
  ImGui::PopStyleColor();
  ImGui::PushTextWrapPos();
  faint_text(ui, "Blue is exact, red is not. Hollow: another tree is better in all. Click takes.");
  ImGui::PopTextWrapPos();
  ImGui::PopFont();
  if (!nearest) return;
  ui.state.hovered_result = nearest->source;
  ImGui::SetTooltip(
      "%s: %d literals, size %d, proximity %.3f,\nIoU %.4f, mean error %s", nearest->source.c_str(),
      literal_count(nearest->found.tree), tree_size(nearest->found.tree),
      nearest->found.score.proximity, nearest->found.score.iou,
      short_number(nearest->found.score.mean_distance * nearest->found.prepared.mesh->diagonal())
          .c_str());
  if (is_clicked && nearest != ui.session.current_result()) {
    static_cast<void>(ui.session.execute(SetPlan{nearest->plan}));
  }
}

void draw_empty(Ui& ui) {
  if (!ui.session.document().is_ready()) {
    faint_text(ui, "nothing yet");
    return;
  }
  ImGui::PushTextWrapPos();
  if (!ui.session.failure().empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.bad);
    ImGui::TextUnformatted(ui.session.failure().c_str());
    ImGui::PopStyleColor();
    faint_text(ui, "Try a cut through the groups that are not one surface, or fewer partitions.");
  } else {
    faint_text(ui, "No tree yet.");
  }
  ImGui::PopTextWrapPos();
}

}  // namespace

void draw_result_panel(Ui& ui, const PanelArea& area) {
  begin_panel("result", area);
  ui.state.hovered_result.clear();
  ui.state.active_field.clear();
  if (ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows)) ui.state.hovered_literal = -1;
  heading(ui, "Result");
  const auto result = ui.session.shown_result();
  const bool is_current = result && result == ui.session.current_result();
  const float half = (ImGui::GetContentRegionAvail().x - ui.px(8)) / 2;
  action_button(ui, "Reconstruct", with_icon(ui, icon::kPlay, "Reconstruct").c_str(), half);
  ImGui::SameLine();
  const bool is_live = ui.session.is_live();
  ImGui::PushID("live");
  if (toggle_button(ui, with_icon(ui, icon::kBolt, is_live ? "Live: on" : "Live: off"), is_live)) {
    ui.session.set_live(!is_live);
  }
  ImGui::PopID();
  action_tip(action_named(ui, "Live reconstruction"));
  if (!result) {
    draw_empty(ui);
    ImGui::End();
    return;
  }
  if (!is_current) {
    ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.warning);
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted(ui.session.failure().empty()
                               ? "The plan has changed since this tree was found."
                               : ui.session.failure().c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
  }
  ImGui::Dummy({0, ui.px(4)});
  draw_numbers(ui, *result);
  ImGui::Dummy({0, ui.px(4)});
  if (ImGui::BeginTabBar("views")) {
    if (ImGui::BeginTabItem("Tree")) {
      const bool has_pick = ui.state.picked_literal >= 0;
      ImGui::PushFont(ui.fonts.small);
      if (ImGui::BeginChild("tree", {0, has_pick ? -ui.px(204) : 0}, false,
                            ImGuiWindowFlags_HorizontalScrollbar)) {
        if (!result->found.tree.is_empty()) {
          draw_node(ui, result->found.tree, result->found.tree.root, {});
        }
      }
      ImGui::EndChild();
      ImGui::PopFont();
      draw_inspector(ui, *result);
      ImGui::EndTabItem();
    }
    if (ImGui::BeginTabItem("Pareto")) {
      draw_pareto(ui);
      ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
  }
  ImGui::End();
}

}  // namespace hewn
