#include "ui/tools/measure.h"

#include <algorithm>

#include "core/session/describe.h"
#include "ui/tools/marks.h"

namespace hewn {
namespace {

/// Those that were taken and the one that would be next.
std::vector<Spot> spots_now(const MeasureState& measure) {
  std::vector<Spot> spots = measure.spots;
  if (spots.size() < 2 && measure.hovered) spots.push_back(*measure.hovered);
  return spots;
}

bool is_measuring(const Ui& ui) {
  return ui.state.tool == Tool::Measure && ui.session.document().is_ready();
}

}  // namespace

void hover_spot(Ui& ui, const ViewArea& area, const std::array<float, 2>& pixel, int group,
                const Corner* corner) {
  ui.state.measure.hovered.reset();
  if (!is_measuring(ui)) return;
  if (corner) ui.state.measure.hovered = Spot{corner->at, corner->groups.front(), true};
  if (corner || group < 0) return;
  const PreparedMesh& prepared = *ui.session.document().prepared;
  const ViewRay ray = ray_at(ui, area, pixel);
  Pointing pointing;
  pointing.origin = ray.origin + prepared.mesh->bounds.center();
  pointing.direction = ray.direction;
  pointing.group = group;
  if (const auto& section = ui.state.section) {
    pointing.cut_normal = section->normal;
    pointing.cut_offset = section->offset;
  }
  ui.state.measure.hovered = spot_at(prepared, pointing);
}

void take_spot(MeasureState& measure) {
  if (!measure.hovered || measure.spots.size() == 2) measure.spots.clear();
  if (measure.hovered) measure.spots.push_back(*measure.hovered);
}

std::vector<Dimension> measured(const Ui& ui) {
  if (!is_measuring(ui)) return {};
  const PreparedMesh& prepared = *ui.session.document().prepared;
  const std::vector<Spot> spots = spots_now(ui.state.measure);
  if (spots.empty()) return {};
  return spots.size() == 1 ? dimensions_of(prepared, spots[0])
                           : dimensions_between(prepared, spots[0], spots[1]);
}

std::string dimension_text(const Dimension& dimension) {
  return short_number(dimension.value) + (dimension.is_angle ? "\u00b0" : "");
}

void draw_measure(const Ui& ui, const ViewArea& area) {
  if (!is_measuring(ui)) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 accent = ImGui::GetColorU32(ui.theme.accent);
  const std::vector<Spot> spots = spots_now(ui.state.measure);
  if (spots.size() == 2) {
    const Dimension shown = measured(ui).front();
    const bool has_line = shown.from != shown.to;
    const ImVec2 from = to_pixel(ui, area, has_line ? shown.from : spots[0].at);
    const ImVec2 to = to_pixel(ui, area, has_line ? shown.to : spots[1].at);
    if (has_line) {
      const ImU32 faint = ImGui::GetColorU32(ui.theme.text);
      list.AddLine(to_pixel(ui, area, spots[0].at), from, faint);
      list.AddLine(to_pixel(ui, area, spots[1].at), to, faint);
      list.AddLine(from, to, accent, 2 * ui.scale);
    }
    draw_label(ui, {(from.x + to.x) / 2, (from.y + to.y) / 2}, dimension_text(shown));
  }
  for (const Spot& spot : spots) {
    const ImVec2 at = to_pixel(ui, area, spot.at);
    // Corners are caught exactly, places on a face are not.
    list.AddCircleFilled(at, (spot.is_corner ? 5.0F : 3.5F) * ui.scale, accent);
    list.AddCircle(at, 6 * ui.scale, ImGui::GetColorU32(ui.theme.raised), 0, 1.5F * ui.scale);
  }
}

}  // namespace hewn
