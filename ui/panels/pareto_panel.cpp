#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/session/describe.h"
#include "ui/panels/widgets.h"

namespace hewn {
namespace {

/// Axis limits with a margin, so that no dot sits on the frame.
struct Range {
  double lo = kInfinity, hi = -kInfinity;
  void add(double v) {
    lo = std::min(lo, v);
    hi = std::max(hi, v);
  }
  float place(double v, float from, float to) const {
    const double span = hi > lo ? hi - lo : 1;
    const double share = hi > lo ? (v - lo) / span : 0.5;
    return from + static_cast<float>(0.08 + 0.84 * share) * (to - from);
  }
};

/// Blue is exact, red is not: on a logarithmic scale of the mean error.
ImVec4 error_colour(const Ui& ui, double mean) {
  const double t = std::clamp((std::log10(std::max(mean, 1e-6)) + 5) / 3, 0.0, 1.0);
  const auto mix = static_cast<float>(t);
  const ImVec4 &a = ui.theme.accent, &b = ui.theme.bad;
  return {a.x + (b.x - a.x) * mix, a.y + (b.y - a.y) * mix, a.z + (b.z - a.z) * mix, 1};
}

/// Whether another result is at least as good in all three measures and better in one.
bool is_dominated(const FoundResult& r, const Session& session) {
  const auto values = [](const FoundResult& f) {
    return std::array<double, 3>{static_cast<double>(tree_size(f.found.tree)),
                                 -f.found.score.proximity, -f.found.score.agreement};
  };
  const auto own = values(r);
  return std::any_of(session.results().begin(), session.results().end(), [&](const auto& other) {
    const auto theirs = values(*other);
    bool is_better = false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (theirs[k] > own[k]) return false;
      is_better |= theirs[k] < own[k];
    }
    return is_better;
  });
}

}  // namespace

void draw_pareto(Ui& ui) {
  const auto& results = ui.session.results();
  if (results.size() < 2) {
    ImGui::PushTextWrapPos();
    faint_text(ui,
               "One tree so far. \"Search variants\" looks for others with six other settings.");
    ImGui::PopTextWrapPos();
    action_button(ui, "Search variants");
    return;
  }
  Range sizes, proximities;
  for (const auto& r : results) {
    sizes.add(tree_size(r->found.tree));
    proximities.add(r->found.score.proximity);
  }
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = ui.px(180);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + width, at.y + height}, ImGui::GetColorU32(ui.theme.raised),
                     ui.px(4));
  const auto shown = ui.session.shown_result();
  ImGui::InvisibleButton("pareto", {width, height});
  const bool is_over = ImGui::IsItemHovered();
  const bool is_clicked = ImGui::IsItemClicked();  // the texts below are items, too
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  std::shared_ptr<const FoundResult> nearest;
  float best = ui.px(14);
  for (const auto& r : results) {
    const float x = sizes.place(tree_size(r->found.tree), at.x, at.x + width);
    const float y = proximities.place(r->found.score.proximity, at.y + height, at.y);
    const ImU32 colour = ImGui::GetColorU32(error_colour(ui, r->found.score.mean_distance));
    if (is_dominated(*r, ui.session)) {
      list.AddCircle({x, y}, ui.px(4), colour, 0, 1.5F);
    } else {
      list.AddCircleFilled({x, y}, ui.px(5), colour);
    }
    if (r == shown) list.AddCircle({x, y}, ui.px(9), ImGui::GetColorU32(ui.theme.text), 0, 1.5F);
    const float apart = std::hypot(mouse.x - x, mouse.y - y);
    if (!is_over || apart >= best) continue;
    best = apart;
    nearest = r;
  }
  ImGui::PushFont(ui.fonts.small);
  faint_text(ui, fmt::format("size {:.0f} to {:.0f}  \u2192", sizes.lo, sizes.hi));
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.faint);
  right_aligned(fmt::format("\u2191 proximity {:.2f} to {:.2f}", proximities.lo, proximities.hi));
  ImGui::PopStyleColor();
  ImGui::PushTextWrapPos();
  faint_text(ui, "Blue is exact, red is not. Hollow: another tree is better in all. Click takes.");
  ImGui::PopTextWrapPos();
  ImGui::PopFont();
  ui.state.hovered_result = nearest;
  if (!nearest) return;
  ImGui::SetTooltip(
      "%s: %d literals, size %d, proximity %.3f,\nIoU %.4f, mean error %s", nearest->source.c_str(),
      literal_count(nearest->found.tree), tree_size(nearest->found.tree),
      nearest->found.score.proximity, nearest->found.score.iou,
      short_number(nearest->found.score.mean_distance * nearest->found.prepared.mesh->diagonal())
          .c_str());
  if (is_clicked && nearest != ui.session.current_result()) {
    static_cast<void>(ui.session.execute(SetPlan{plan_text(nearest->project)}));
  }
}

}  // namespace hewn
