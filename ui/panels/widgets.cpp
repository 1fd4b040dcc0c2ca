#include "ui/panels/widgets.h"

namespace hewn {

void begin_panel(const char* name, const PanelArea& area, ImGuiWindowFlags extra) {
  ImGui::SetNextWindowPos({area.x, area.y});
  ImGui::SetNextWindowSize({area.width, area.height});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoTitleBar |
                   ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                   ImGuiWindowFlags_NoNav | extra);
}

void begin_card(const Ui& ui, const char* name, float x, float y, ImVec2 anchor) {
  ImGui::SetNextWindowPos({x, y}, ImGuiCond_Always, anchor);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.theme.raised);
  ImGui::PushStyleColor(ImGuiCol_Border, ui.theme.line);
  ImGui::PushStyleColor(ImGuiCol_Button, ui.theme.panel);
  ImGui::PushStyleColor(ImGuiCol_FrameBg, ui.theme.panel);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(4));
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
}

void end_card() {
  ImGui::End();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor(4);
}

void heading(const Ui& ui, const char* text) {
  ImGui::Dummy({0, ui.px(4)});
  ImGui::PushFont(ui.fonts.heading);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

void faint_text(const Ui& ui, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.faint);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

void right_aligned(const std::string& text) {
  const float space = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  if (space > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + space);
  ImGui::TextUnformatted(text.c_str());
}

void action_tip(const Action& action) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  const std::string key = shortcut_text(action);
  ImGui::SetTooltip("%s%s%s%s", action.help, key.empty() ? "" : "  [", key.c_str(),
                    key.empty() ? "" : "]");
}

bool action_button(Ui& ui, const char* title, const char* label, float width) {
  const Action& action = action_named(ui, title);
  const bool is_enabled = action.is_enabled(ui);
  ImGui::BeginDisabled(!is_enabled);
  const bool is_pressed = ImGui::Button(label ? label : title, {width, 0});
  ImGui::EndDisabled();
  action_tip(action);
  if (is_pressed) action.run(ui);
  return is_pressed;
}

bool toggle_button(const Ui& ui, const std::string& label, bool is_on, float width) {
  if (is_on) {
    ImVec4 fill = ui.theme.accent;
    fill.w = 0.28F;
    ImGui::PushStyleColor(ImGuiCol_Button, fill);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, fill);
  }
  const bool is_pressed = ImGui::Button(label.c_str(), {width, 0});
  if (is_on) ImGui::PopStyleColor(2);
  return is_pressed;
}

std::string with_icon(const Ui& ui, const char* icon, const std::string& text) {
  if (!ui.fonts.has_icons) return text;
  return text.empty() ? icon : std::string(icon) + "  " + text;
}

void dot(const Ui& ui, const ImVec4& colour) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight();
  ImGui::GetWindowDrawList()->AddCircleFilled({at.x + ui.px(5), at.y + line / 2 + ui.px(1)},
                                              ui.px(4), ImGui::GetColorU32(colour));
  ImGui::Dummy({ui.px(10), line});
}

std::string fitted(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  std::string cut = text;
  while (!cut.empty() && ImGui::CalcTextSize((cut + "...").c_str()).x > width) {
    do {
      cut.pop_back();
    } while (!cut.empty() && (static_cast<unsigned char>(cut.back()) & 0xC0) == 0x80);
  }
  // A lead byte without its followers must not stay behind.
  if (!cut.empty() && (static_cast<unsigned char>(cut.back()) & 0xC0) == 0xC0) cut.pop_back();
  return cut + "...";
}

}  // namespace hewn
