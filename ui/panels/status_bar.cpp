#include <fmt/format.h>

#include "ui/panels/tree_marks.h"
#include "ui/panels/widgets.h"

namespace hewn {
namespace {

void draw_job(const Ui& ui, const JobStatus& job) {
  ImGui::TextUnformatted(job.name.c_str());
  if (!job.is_running) {
    ImGui::SameLine();
    faint_text(ui, "waiting");
    return;
  }
  ImGui::SameLine();
  faint_text(ui, fmt::format("{}  {:.1f} s", job.stage, job.seconds));
  ImGui::SameLine();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ui.px(120);
  const float y = at.y + ImGui::GetTextLineHeight() / 2;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({at.x, y - ui.px(2)}, {at.x + width, y + ui.px(2)},
                     ImGui::GetColorU32(ui.theme.line), ui.px(2));
  list.AddRectFilled({at.x, y - ui.px(2)},
                     {at.x + width * static_cast<float>(job.share), y + ui.px(2)},
                     ImGui::GetColorU32(ui.theme.accent), ui.px(2));
  ImGui::Dummy({width, ImGui::GetTextLineHeight()});
}

const char* hint_of(Tool tool) {
  switch (tool) {
    case Tool::Knife:
      return "drag a line across the part; Alt: no snapping";
    case Tool::Lasso:
      return "draw around the groups";
    case Tool::Box:
      return "drag a box: to the right encloses, to the left touches";
    case Tool::Measure:
      return "click two faces, or corners; Esc leaves";
    case Tool::Select:
      break;
  }
  return "ready";
}

std::string counts_text(const Ui& ui) {
  const Document& document = ui.session.document();
  if (!document.is_ready()) return {};
  std::string digits = std::to_string(document.prepared->mesh->triangles.size());
  for (int i = static_cast<int>(digits.size()) - 3; i > 0; i -= 3) {
    digits.insert(static_cast<std::size_t>(i), ",");
  }
  return fmt::format("{}    {} triangles    {} groups    {} selected", ui.session.device(), digits,
                     document.prepared->segmentation.groups.size(), ui.state.selected.size());
}

}  // namespace

void draw_status_bar(Ui& ui, const PanelArea& area) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(8), ui.px(5)});
  begin_panel("status", area, ImGuiWindowFlags_NoScrollbar);
  if (ImGui::IsWindowHovered()) hover_nothing(ui.state);
  ImGui::PushFont(ui.fonts.small);
  const auto jobs = ui.session.jobs();
  if (jobs.empty()) {
    faint_text(ui, hint_of(ui.state.tool));
  } else {
    draw_job(ui, jobs.front());
    ImGui::SameLine();
    if (jobs.size() > 1) {
      faint_text(ui, fmt::format("+{} waiting", jobs.size() - 1));
      ImGui::SameLine();
    }
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(6), 0});
    if (ImGui::Button("cancel")) ui.session.cancel_jobs();
    ImGui::PopStyleVar();
  }
  const std::string counts = counts_text(ui);
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.faint);
  right_aligned(counts);
  ImGui::PopStyleColor();
  ImGui::PopFont();
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace hewn
