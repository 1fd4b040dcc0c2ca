#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "core/session/describe.h"
#include "ui/panels/tree_marks.h"
#include "ui/panels/widgets.h"
#include "ui/tools/knife.h"
#include "ui/tools/section.h"

namespace hewn {
namespace {

void draw_cut(Ui& ui, int index) {
  const CutStep& cut = ui.session.document().project.cuts[index];
  ImGui::PushID(index);
  const int axis = axis_across(cut.normal);
  ImGui::AlignTextToFramePadding();
  if (axis >= 0) {
    ImGui::Text("%c =", "xyz"[axis]);
  } else {
    ImGui::TextUnformatted("oblique at");
    if (ImGui::IsItemHovered()) {
      ImGui::SetTooltip("normal %.9g, %.9g, %.9g", cut.normal.x(), cut.normal.y(), cut.normal.z());
    }
  }
  ImGui::SameLine();
  double offset = axis >= 0 ? cut.offset * cut.normal[axis] : cut.offset;
  const double shown = offset;
  ImGui::SetNextItemWidth(-ui.px(76));
  const bool is_done =
      ImGui::InputDouble("##offset", &offset, 0, 0, "%.6g", ImGuiInputTextFlags_EnterReturnsTrue);
  if (is_done && offset != shown) {
    const double signed_offset = axis >= 0 ? offset * cut.normal[axis] : offset;
    static_cast<void>(ui.session.execute(MoveCut{index, cut.normal, signed_offset}));
  }
  ImGui::SameLine(0, ui.px(4));
  if (ImGui::Button(ui.fonts.has_icons ? icon::kMove : "m")) {
    ui.state.take_up(Tool::Knife);
    ui.state.selected.clear();
    set_knife_plane(ui, {cut.normal, cut.offset, ""});
    ui.state.knife.placed_cut = index;
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Move and turn this cut with handles.");
  ImGui::SameLine(0, ui.px(4));
  if (ImGui::Button(ui.fonts.has_icons ? icon::kTrash : "x")) {
    static_cast<void>(ui.session.execute(DeleteCut{index}));
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Delete this cut.");
  ImGui::PopID();
}

void draw_cuts(Ui& ui) {
  const auto& project = ui.session.document().project;
  if (project.cuts.empty() && project.merges.empty()) return;
  heading(ui, "Cuts and merges");
  for (int i = 0; i < static_cast<int>(ui.session.document().project.cuts.size()); ++i) {
    draw_cut(ui, i);
  }
  for (int i = 0; i < static_cast<int>(ui.session.document().project.merges.size()); ++i) {
    ImGui::PushID(1000 + i);
    ImGui::AlignTextToFramePadding();
    ImGui::Text("merge of %zu groups", ui.session.document().project.merges[i].size());
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ui.px(28));
    if (ImGui::Button(ui.fonts.has_icons ? icon::kTrash : "x")) {
      static_cast<void>(ui.session.execute(DeleteMerge{i}));
    }
    ImGui::PopID();
  }
}

void draw_group(Ui& ui, int g) {
  const Segmentation& segmentation = ui.session.document().prepared->segmentation;
  const FaceGroup& group = segmentation.groups[g];
  ImGui::PushID(g);
  const bool is_selected =
      std::binary_search(ui.state.selected.begin(), ui.state.selected.end(), g);
  const bool is_hidden = ui.state.hidden.contains(g);
  const LabelState dot = ui.state.colours == ColourMode::Kind
                             ? kind_state(group.surface.kind, group.is_fitted)
                             : group_colour(ui, g);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight();
  if (ImGui::Selectable("##group", is_selected || ui.state.hovered == g)) {
    const ImGuiIO& io = ImGui::GetIO();
    const Combine how =
        io.KeyCtrl ? Combine::Toggle : (io.KeyShift ? Combine::Add : Combine::Replace);
    ui.state.selected = combined(ui.state.selected, {g}, how);
  }
  if (ImGui::IsItemHovered()) ui.state.hovered_groups = {g};
  ImGui::GetWindowDrawList()->AddRectFilled({at.x + ui.px(2), at.y + line / 2 - ui.px(5)},
                                            {at.x + ui.px(12), at.y + line / 2 + ui.px(5)},
                                            ImGui::GetColorU32(to_colour(dot)), ui.px(3));
  ImGui::SameLine(ui.px(24));
  if (is_hidden) ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.faint);
  ImGui::TextUnformatted(
      fmt::format("{}  {}{}", g, describe_group(group), is_hidden ? "  (hidden)" : "").c_str());
  if (is_hidden) ImGui::PopStyleColor();
  ImGui::SameLine();
  const double share = 100 * group.area / ui.session.document().prepared->mesh->total_area;
  ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.faint);
  right_aligned(fmt::format("{:.1f}", share));
  ImGui::PopStyleColor();
  ImGui::PopID();
}

void draw_groups(Ui& ui) {
  const Document& document = ui.session.document();
  if (!document.is_ready()) return;
  const int count = static_cast<int>(document.prepared->segmentation.groups.size());
  heading(ui, fmt::format("Groups  {}", count).c_str());
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.faint);
  right_aligned("% of area");
  ImGui::PopStyleColor();
  ImGui::PushFont(ui.fonts.small);
  if (ImGui::BeginChild("groups")) {
    ImGuiListClipper clipper;
    clipper.Begin(count);
    while (clipper.Step()) {
      for (int g = clipper.DisplayStart; g < clipper.DisplayEnd; ++g) draw_group(ui, g);
    }
  }
  ImGui::EndChild();
  ImGui::PopFont();
}

}  // namespace

void draw_plan_panel(Ui& ui, const PanelArea& area) {
  begin_panel("plan", area);
  if (ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows)) hover_nothing(ui.state);
  draw_partitions(ui);
  draw_cuts(ui);
  draw_groups(ui);
  ImGui::End();
}

}  // namespace hewn
