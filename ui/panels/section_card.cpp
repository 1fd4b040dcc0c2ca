/// Where the section lies, in numbers.
#include <algorithm>

#include <fmt/format.h>

#include "ui/panels/widgets.h"
#include "ui/tools/section.h"

namespace hewn {

void draw_section_card(Ui& ui, const PanelArea& view) {
  if (!ui.state.section || !ui.session.document().is_ready()) return;
  ViewPlane& plane = *ui.state.section;
  const int axis = axis_across(plane.normal);
  // Across an axis the number is the coordinate, whichever half is shown.
  const double sign = axis >= 0 && plane.normal[axis] < 0 ? -1 : 1;
  const auto [lo, hi] = extent_along(ui, sign * plane.normal);
  begin_card(ui, "section", view.x + ui.px(12), view.y + ui.px(12), {0, 0});
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(
      axis < 0 ? "oblique" : fmt::format("{} {}", "xyz"[axis], sign < 0 ? ">" : "<").c_str());
  ImGui::SameLine();
  double offset = std::clamp(sign * plane.offset, lo, hi);
  ImGui::SetNextItemWidth(ui.px(140));
  bool is_changed = ImGui::SliderScalar("##share", ImGuiDataType_Double, &offset, &lo, &hi, "");
  ImGui::SameLine(0, ui.px(4));
  ImGui::SetNextItemWidth(ui.px(72));
  is_changed |=
      ImGui::InputDouble("##offset", &offset, 0, 0, "%.5g", ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Where the section lies, in model units.");
  if (is_changed) plane.offset = sign * offset;
  ImGui::SameLine();
  if (ImGui::Button("flip")) flip_section(plane);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Show the other half.");
  ImGui::SameLine(0, ui.px(4));
  if (ImGui::Button("off")) ui.state.section.reset();
  end_card();
}

}  // namespace hewn
