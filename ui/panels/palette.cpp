#include <algorithm>
#include <cctype>
#include <cstring>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/panels/widgets.h"

namespace hewn {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Every letter of the pattern occurs in order; fewer letters between them rank first.
int rank(const std::string& text, const std::string& pattern) {
  const std::size_t at = text.find(pattern);
  if (at != std::string::npos) return static_cast<int>(at);
  std::size_t from = 0;
  for (const char c : pattern) {
    from = text.find(c, from);
    if (from == std::string::npos) return -1;
    ++from;
  }
  return 100 + static_cast<int>(from);
}

std::vector<const Action*> matches(const Ui& ui) {
  std::vector<std::pair<int, const Action*>> ranked;
  const std::string pattern = lower(ui.state.palette_text);
  for (const Action& action : *ui.actions) {
    const int r = rank(lower(action.title), pattern);
    if (r >= 0) ranked.emplace_back(r, &action);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const Action*> out;
  out.reserve(ranked.size());
  for (const auto& [r, action] : ranked) out.push_back(action);
  return out;
}

}  // namespace

void draw_palette(Ui& ui, const PanelArea& window) {
  if (!ui.state.shows_palette) return;
  begin_card(ui, "palette", window.x + window.width / 2, window.y + ui.px(64), {0.5F, 0});
  ImGui::SetNextItemWidth(ui.px(440));
  if (ImGui::IsWindowAppearing()) {
    ImGui::SetWindowFocus();
    ImGui::SetKeyboardFocusHere();
  }
  const bool is_enter = ImGui::InputTextWithHint(
      "##command", "Find a command", &ui.state.palette_text, ImGuiInputTextFlags_EnterReturnsTrue);
  const auto found = matches(ui);
  constexpr std::size_t kMost = 12;
  const Action* chosen = is_enter && !found.empty() ? found.front() : nullptr;
  for (std::size_t i = 0; i < std::min(found.size(), kMost); ++i) {
    const Action& action = *found[i];
    ImGui::PushID(static_cast<int>(i));
    const bool is_enabled = action.is_enabled(ui);
    ImGui::BeginDisabled(!is_enabled);
    if (ImGui::Selectable(action.title, i == 0, 0, {ui.px(440), 0})) chosen = &action;
    ImGui::EndDisabled();
    const std::string key = shortcut_text(action);
    ImGui::SameLine(ui.px(8) + ui.px(440) - ImGui::CalcTextSize(key.c_str()).x);
    faint_text(ui, key);
    ImGui::PopID();
  }
  if (found.empty()) faint_text(ui, "no command of this name");
  end_card();
  if (!chosen) return;
  ui.state.shows_palette = false;
  if (chosen->is_enabled(ui)) chosen->run(ui);
}

void draw_keys(Ui& ui, const PanelArea& window) {
  if (!ui.state.shows_keys) return;
  begin_card(ui, "keys", window.x + window.width / 2, window.y + window.height / 2, {0.5F, 0.5F});
  ImGui::PushFont(ui.fonts.heading);
  ImGui::TextUnformatted("Keys");
  ImGui::PopFont();
  ImGui::PushFont(ui.fonts.small);
  if (ImGui::BeginTable("keys", 3, ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableNextRow();
    const std::vector<std::vector<const char*>> columns = {
        {"File", "Edit"}, {"Select", "Help"}, {"View"}};
    for (const auto& menus : columns) {
      ImGui::TableNextColumn();
      ImGui::Dummy({ui.px(260), 0});
      for (const char* menu : menus) {
        heading(ui, menu);
        for (const Action& action : *ui.actions) {
          if (std::strcmp(action.menu, menu) != 0 || action.key == 0) continue;
          const float x = ImGui::GetCursorPosX();
          faint_text(ui, shortcut_text(action));
          ImGui::SameLine();
          ImGui::SetCursorPosX(x + ui.px(96));
          ImGui::TextUnformatted(action.title);
        }
      }
    }
    ImGui::EndTable();
  }
  ImGui::Dummy({0, ui.px(4)});
  faint_text(ui,
             "Mouse: left selects, drag boxes, middle (or Alt and left) orbits, right pans, wheel "
             "zooms at the cursor.\nShift adds, Ctrl toggles, Shift and Ctrl remove. Space, held, "
             "shows the input.");
  ImGui::PopFont();
  end_card();
}

}  // namespace hewn
