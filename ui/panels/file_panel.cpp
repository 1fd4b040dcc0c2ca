#include <algorithm>
#include <cctype>
#include <iterator>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/session/tree_file.h"
#include "ui/panels/widgets.h"

namespace hewn {
namespace {

using Kind = FileRequest::Kind;

struct Entry {
  std::string name;
  bool is_folder = false;
};

bool is_readable_kind(const std::filesystem::path& path) {
  static constexpr const char* kKnown[] = {".off", ".stl", ".obj", ".ply", ".json"};
  return std::find(std::begin(kKnown), std::end(kKnown), lower_extension(path)) != std::end(kKnown);
}

std::vector<Entry> list_folder(const FileRequest& file) {
  std::vector<Entry> entries;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(file.folder, failure)) {
    const std::string name = entry.path().filename().string();
    if (name.empty() || name.front() == '.') continue;
    const bool is_folder = entry.is_directory(failure);
    if (is_folder || is_readable_kind(entry.path())) entries.push_back({name, is_folder});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.is_folder != b.is_folder ? a.is_folder : a.name < b.name;
  });
  return entries;
}

std::filesystem::path path_of(const FileRequest& file) {
  const std::filesystem::path name(file.name);
  return name.is_absolute() ? name : file.folder / name;
}

void finish(Ui& ui) {
  FileRequest& file = ui.state.file;
  const std::filesystem::path path = path_of(file);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    file.folder = path;
    file.name.clear();
    return;
  }
  if (file.kind == Kind::Open) {
    if (request_open(ui, path)) file.kind = Kind::None;
    return;
  }
  Result<void> done;
  if (file.kind == Kind::SaveProject) done = ui.session.execute(SaveProject{path});
  if (file.kind == Kind::Export) done = ui.session.execute(ExportTree{path});
  if (done) file.kind = Kind::None;
}

void draw_entries(Ui& ui) {
  FileRequest& file = ui.state.file;
  ImGui::BeginChild("files", {ui.px(480), ui.px(260)}, true);
  if (ImGui::Selectable("..", false, ImGuiSelectableFlags_AllowDoubleClick)) {
    file.folder = file.folder.parent_path();
  }
  for (const Entry& entry : list_folder(file)) {
    const char* sign = entry.is_folder ? icon::kFolder : icon::kFile;
    const std::string label = with_icon(ui, sign, entry.name);
    if (!ImGui::Selectable(label.c_str(), file.name == entry.name,
                           ImGuiSelectableFlags_AllowDoubleClick)) {
      continue;
    }
    if (entry.is_folder) {
      file.folder /= entry.name;
      break;
    }
    file.name = entry.name;
    if (ImGui::IsMouseDoubleClicked(0)) finish(ui);
  }
  ImGui::EndChild();
}

}  // namespace

void draw_file_panel(Ui& ui, const PanelArea& window) {
  FileRequest& file = ui.state.file;
  if (file.kind == Kind::None) return;
  begin_card(ui, "files", window.x + window.width / 2, window.y + ui.px(64), {0.5F, 0});
  ImGui::PushFont(ui.fonts.heading);
  ImGui::TextUnformatted(file.kind == Kind::Open          ? "Open a mesh or a project"
                         : file.kind == Kind::SaveProject ? "Save the project"
                                                          : "Export the tree");
  ImGui::PopFont();
  faint_text(ui, fitted(file.folder.string(), ui.px(480)));
  draw_entries(ui);
  if (file.kind == Kind::Export) {
    faint_text(ui, "format by extension: .scad .json .stl .off .obj .ply .step");
  }
  ImGui::SetNextItemWidth(ui.px(480) - ui.px(176));
  if (!file.has_focus) {
    ImGui::SetWindowFocus();
    ImGui::SetKeyboardFocusHere();
    file.has_focus = true;
  }
  const bool is_enter =
      ImGui::InputText("##name", &file.name, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  const char* verb = file.kind == Kind::Open          ? "Open"
                     : file.kind == Kind::SaveProject ? "Save"
                                                      : "Export";
  const bool is_pressed = ImGui::Button(verb, {ui.px(80), 0});
  ImGui::SameLine();
  const bool is_cancelled = ImGui::Button("Cancel", {ui.px(80), 0});
  std::error_code ignored;
  const bool is_writing = file.kind != Kind::Open && !file.name.empty();
  if (is_writing && std::filesystem::is_regular_file(path_of(file), ignored)) {
    ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.warning);
    ImGui::TextUnformatted("There is a file of this name; it will be replaced.");
    ImGui::PopStyleColor();
  }
  end_card();
  if (is_cancelled) file.kind = Kind::None;
  if ((is_enter || is_pressed) && !file.name.empty()) finish(ui);
}

}  // namespace hewn
