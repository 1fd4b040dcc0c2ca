/// What was done and said in this session.
#include "ui/panels/widgets.h"

namespace hewn {
namespace {

ImVec4 severity_colour(const Theme& theme, Severity severity) {
  switch (severity) {
    case Severity::Error:
      return theme.bad;
    case Severity::Warning:
      return theme.warning;
    case Severity::Info:
      break;
  }
  return theme.text;
}

std::string as_text(const std::vector<Notice>& notes) {
  std::string all;
  for (const Notice& note : notes) all += note.text + "\n";
  return all;
}

}  // namespace

void draw_log(Ui& ui, const PanelArea& view) {
  if (!ui.state.shows_log) return;
  const std::vector<Notice>& notes = ui.session.journal();
  const float width = std::min(ui.px(720), view.width - ui.px(24));
  begin_card(ui, "log", view.x + view.width / 2, view.y + view.height - ui.px(12), {0.5F, 1});
  heading(ui, "Log");
  ImGui::SameLine(width - ui.px(112));
  if (ImGui::Button("Copy", {ui.px(56), 0})) ImGui::SetClipboardText(as_text(notes).c_str());
  ImGui::SameLine(0, ui.px(8));
  if (ImGui::Button("Close", {ui.px(56), 0})) ui.state.shows_log = false;
  ImGui::PushFont(ui.fonts.small);
  if (ImGui::BeginChild("notes", {width, ui.px(180)})) {
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(notes.size()));
    while (clipper.Step()) {
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        const Notice& note = notes[i];
        ImGui::PushStyleColor(ImGuiCol_Text, severity_colour(ui.theme, note.severity));
        ImGui::TextUnformatted(fitted(note.text, width - ui.px(16)).c_str());
        ImGui::PopStyleColor();
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", note.text.c_str());
      }
    }
    // New lines are followed unless somebody looks at older ones.
    if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) ImGui::SetScrollHereY(1);
  }
  ImGui::EndChild();
  ImGui::PopFont();
  end_card();
}

}  // namespace hewn
