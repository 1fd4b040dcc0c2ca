/// What was measured, in numbers that can be copied.
#include <fmt/format.h>

#include "ui/panels/widgets.h"
#include "ui/tools/measure.h"

namespace hewn {
namespace {

/// A click copies the number in full.
void draw_dimension(const Ui& ui, const Dimension& dimension) {
  faint_text(ui, dimension.what);
  ImGui::SameLine(0, ui.px(6));
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(dimension_text(dimension).c_str());
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%.10g %s; click copies it", dimension.value,
                      dimension.is_angle ? "degrees" : "model units");
  }
  if (ImGui::IsItemClicked()) {
    ImGui::SetClipboardText(fmt::format("{:.10g}", dimension.value).c_str());
  }
}

}  // namespace

void draw_measure_card(Ui& ui, const PanelArea& view) {
  if (ui.state.tool != Tool::Measure || !ui.session.document().is_ready()) return;
  begin_card(ui, "measure", view.x + view.width / 2, view.y + view.height - ui.px(12), {0.5F, 1});
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(with_icon(ui, icon::kMeasure, "").c_str());
  ImGui::SameLine();
  const auto dimensions = measured(ui);
  for (const Dimension& dimension : dimensions) {
    draw_dimension(ui, dimension);
    ImGui::SameLine(0, ui.px(16));
  }
  const std::size_t count = ui.state.measure.spots.size();
  if (count == 0) {
    faint_text(ui, "click where to measure from; corners catch the mouse");
  } else {
    faint_text(ui, count == 1 ? "click where to measure to" : "");
  }
  end_card();
}

}  // namespace hewn
