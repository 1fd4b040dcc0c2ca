#include <cstring>

#include "ui/panels/widgets.h"

namespace hewn {
namespace {

void draw_menu(Ui& ui, const char* menu) {
  if (!ImGui::BeginMenu(menu)) return;
  for (const Action& action : *ui.actions) {
    if (std::strcmp(action.menu, menu) != 0) continue;
    const std::string key = shortcut_text(action);
    if (ImGui::MenuItem(action.title, key.c_str(), false, action.is_enabled(ui))) action.run(ui);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", action.help);
  }
  if (std::strcmp(menu, "File") == 0 && !ui.state.recent.empty()) {
    ImGui::Separator();
    for (const auto& path : std::vector(ui.state.recent)) {
      if (ImGui::MenuItem(path.filename().string().c_str())) {
        request_open(ui, path);
      }
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", path.string().c_str());
    }
  }
  ImGui::EndMenu();
}

std::string title_text(const Ui& ui) {
  const Project& project = ui.session.document().project;
  if (project.mesh.empty()) return "no part";
  const std::string name = ui.session.project_path().empty()
                               ? project.mesh.filename().string()
                               : ui.session.project_path().filename().string();
  return ui.session.is_modified() ? name + " *" : name;
}

}  // namespace

void draw_menu_bar(Ui& ui) {
  ImGui::PushFont(ui.fonts.heading);
  ImGui::TextUnformatted("Hewn");
  ImGui::PopFont();
  ImGui::SameLine(0, ui.px(16));
  for (const char* menu : {"File", "Edit", "Select", "View", "Help"}) draw_menu(ui, menu);
  const std::string title = title_text(ui);
  const float middle = (ImGui::GetWindowWidth() - ImGui::CalcTextSize(title.c_str()).x) / 2;
  ImGui::SameLine(middle);
  ImGui::TextUnformatted(title.c_str());
  const std::string find = with_icon(ui, icon::kSearch, "Find a command   Ctrl+K");
  const float width = ImGui::CalcTextSize(find.c_str()).x + ui.px(24);
  // The bar begins its lines a frame's padding from the left, and the place counts from there.
  ImGui::SameLine(ImGui::GetWindowWidth() - width - ui.px(16));
  ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.faint);
  if (ImGui::Button(find.c_str(), {width, 0})) action_named(ui, "Find a command").run(ui);
  ImGui::PopStyleColor();
}

}  // namespace hewn
