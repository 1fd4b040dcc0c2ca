#include "ui/panels/tree_marks.h"
#include "ui/panels/widgets.h"

namespace hewn {
namespace {

void gap(const Ui& ui) { ImGui::SameLine(0, ui.px(16)); }

/// Icons alone where there are icons: the names would not leave room for the rest at 1280 pixels.
void draw_tool(Ui& ui, const char* symbol, const char* name, Tool tool, const char* title) {
  const std::string label = ui.fonts.has_icons ? std::string(symbol) + "##" + name : name;
  if (toggle_button(ui, label, ui.state.tool == tool)) {
    if (title) {
      action_named(ui, title).run(ui);
    } else {
      ui.state.take_up(tool);
    }
  }
  if (title) {
    action_tip(action_named(ui, title));
  } else if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("Select: click a face; drag on empty space for a box.");
  }
  ImGui::SameLine(0, ui.px(4));
}

void draw_show(Ui& ui, const char* name, ShowMode mode, const char* title) {
  const Action& action = action_named(ui, title);
  const bool is_enabled = action.is_enabled(ui);
  ImGui::BeginDisabled(!is_enabled);
  if (toggle_button(ui, name, ui.state.show == mode)) ui.state.show = mode;
  ImGui::EndDisabled();
  action_tip(action);
  ImGui::SameLine(0, ui.px(4));
}

void draw_flag(Ui& ui, const char* name, bool is_on, const char* title) {
  if (toggle_button(ui, name, is_on)) action_named(ui, title).run(ui);
  action_tip(action_named(ui, title));
  ImGui::SameLine(0, ui.px(4));
}

}  // namespace

void draw_toolbar(Ui& ui, const PanelArea& area) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(8), ui.px(6)});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(6), ui.px(4)});
  begin_panel("toolbar", area, ImGuiWindowFlags_NoScrollbar);
  if (ImGui::IsWindowHovered()) hover_nothing(ui.state);
  draw_tool(ui, icon::kPointer, "Select", Tool::Select, nullptr);
  draw_tool(ui, icon::kBox, "Box", Tool::Box, "Box selection");
  draw_tool(ui, icon::kLasso, "Lasso", Tool::Lasso, "Lasso selection");
  draw_tool(ui, icon::kKnife, "Knife", Tool::Knife, "Knife");
  draw_tool(ui, icon::kMeasure, "Measure", Tool::Measure, "Measure");
  gap(ui);
  draw_show(ui, "Input", ShowMode::Input, "Show input");
  draw_show(ui, "Result", ShowMode::Result, "Show result");
  draw_show(ui, "Overlay", ShowMode::Overlay, "Show overlay");
  draw_show(ui, "Diff", ShowMode::Difference, "Show difference");
  gap(ui);
  ImGui::SetNextItemWidth(ui.px(92));
  int mode = static_cast<int>(ui.state.colours);
  if (ImGui::Combo("##colour", &mode, "group\0type\0partition\0deviation\0")) {
    ui.state.colours = static_cast<ColourMode>(mode);
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("What the colours tell  [Ctrl+1 to Ctrl+4]");
  gap(ui);
  draw_flag(ui, "X-ray", ui.state.is_xray, "X-ray");
  draw_flag(ui, "Wire", ui.state.is_wireframe, "Wireframe");
  draw_flag(ui, "Section", ui.state.section.has_value(), "Section");
  ImGui::NewLine();
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace hewn
