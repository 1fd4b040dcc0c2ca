#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/session/describe.h"
#include "ui/panels/tree_marks.h"
#include "ui/panels/widgets.h"

namespace hewn {
namespace {

/// `full`: the tooltip; a click copies `exact`.
void row(const Ui& ui, const char* name, const std::string& value, const std::string& full,
         const std::string& exact) {
  ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.faint);
  ImGui::TextUnformatted(name);
  ImGui::PopStyleColor();
  ImGui::SameLine();
  right_aligned(value);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("%s\nClick copies %s.", full.c_str(), exact.c_str());
  if (ImGui::IsItemClicked()) ImGui::SetClipboardText(exact.c_str());
}

/// In model units, and beside the name as a share of the diagonal.
void error_row(const Ui& ui, const char* name, double share, double diagonal) {
  const std::string text = fmt::format("{}, {} %", name, short_number(100 * share));
  row(ui, text.c_str(), short_number(share * diagonal),
      fmt::format("{:.6g} model units, {:.4g} % of the diagonal.", share * diagonal, 100 * share),
      fmt::format("{:.17g}", share * diagonal));
}

void draw_numbers(const Ui& ui, const FoundResult& result) {
  const TreeScore& score = result.found.score;
  const double diagonal = result.found.prepared.mesh->diagonal();
  const int literals = literal_count(result.found.tree);
  row(ui, "literals", std::to_string(literals), "Bounded primitives in the tree.",
      std::to_string(literals));
  const std::string size = std::to_string(tree_size(result.found.tree));
  row(ui, "size", size, "Literals and binary operations.", size);
  row(ui, "proximity", fmt::format("{:.3f}", score.proximity),
      "Share of operations whose operands touch: 1 is best.",
      fmt::format("{:.17g}", score.proximity));
  row(ui, "common volume", fmt::format("{:.4f}", score.iou),
      "Intersection over union with the mesh.", fmt::format("{:.17g}", score.iou));
  error_row(ui, "mean error", score.mean_distance, diagonal);
  error_row(ui, "largest error", score.hausdorff, diagonal);
  row(ui, "seconds", fmt::format("{:.2f}", result.seconds), "Time of the search.",
      fmt::format("{:.17g}", result.seconds));
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
  // What reads the same in the field is no choice.
  if (fmt::format("{:.6g}", rounder) != fmt::format("{:.6g}", field.value)) {
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

/// Why the shown tree is not the plan's.
void draw_standing(Ui& ui) {
  const Session& session = ui.session;
  const bool is_searching = session.shows_draft() && session.is_busy();
  const char* text = "The plan has changed since this tree was found.";
  if (session.shows_draft()) {
    text = is_searching ? "A first answer: the search goes on for a better one."
                        : "The search was stopped: this is the best tree that it had found.";
  } else if (!session.failure().empty()) {
    text = session.failure().c_str();
  }
  ImGui::PushStyleColor(ImGuiCol_Text, is_searching ? ui.theme.faint : ui.theme.warning);
  ImGui::PushTextWrapPos();
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
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
  if (ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows)) hover_nothing(ui.state);
  heading(ui, "Result");
  const auto result = ui.session.shown_result();
  const bool is_current = result && result == ui.session.current_result();
  const float half = (ImGui::GetContentRegionAvail().x - ui.px(8)) / 2;
  action_button(ui, "Reconstruct", with_icon(ui, icon::kPlay, "Reconstruct").c_str(), half);
  ImGui::SameLine();
  const bool is_live = ui.session.is_live();
  ImGui::PushID("live");
  const char* live = is_live ? "Live: on" : "Live: off";
  if (toggle_button(ui, with_icon(ui, icon::kBolt, live), is_live, half)) {
    ui.session.set_live(!is_live);
  }
  ImGui::PopID();
  action_tip(action_named(ui, "Live reconstruction"));
  if (!result) {
    draw_empty(ui);
    ImGui::End();
    return;
  }
  if (!is_current) draw_standing(ui);
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
          draw_outline(ui, result->found.tree);
        }
      }
      ImGui::EndChild();
      ImGui::PopFont();
      draw_inspector(ui, *result);
      ImGui::EndTabItem();
    }
    ui.state.shows_graph = ImGui::BeginTabItem("Graph");
    if (ui.state.shows_graph) {
      const bool has_pick = ui.state.picked_literal >= 0;
      const float height = has_pick ? -ui.px(204) : 0;
      if (ImGui::BeginChild("graph", {0, height}, false, ImGuiWindowFlags_NoScrollWithMouse)) {
        draw_graph(ui, result->found.tree);
      }
      ImGui::EndChild();
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
