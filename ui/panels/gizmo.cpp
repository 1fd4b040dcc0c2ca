#include <algorithm>
#include <array>
#include <cmath>

#include "ui/panels/widgets.h"

namespace hewn {
namespace {

struct Tip {
  Vec3 direction;
  StandardView view;
  unsigned colour;
  const char* name;  ///< empty: the far end of an axis
};

const std::array<Tip, 6>& tips() {
  static const std::array<Tip, 6> all{{{Vec3(1, 0, 0), StandardView::Right, 0xe06c75, "x"},
                                       {Vec3(-1, 0, 0), StandardView::Left, 0xe06c75, ""},
                                       {Vec3(0, -1, 0), StandardView::Front, 0x6cc08b, ""},
                                       {Vec3(0, 1, 0), StandardView::Back, 0x6cc08b, "y"},
                                       {Vec3(0, 0, 1), StandardView::Top, 0x61a0ff, "z"},
                                       {Vec3(0, 0, -1), StandardView::Bottom, 0x61a0ff, ""}}};
  return all;
}

ImU32 colour_of(unsigned rgb, float alpha) {
  return ImGui::GetColorU32({static_cast<float>((rgb >> 16) & 255) / 255,
                             static_cast<float>((rgb >> 8) & 255) / 255,
                             static_cast<float>(rgb & 255) / 255, alpha});
}

}  // namespace

void draw_gizmo(Ui& ui, const PanelArea& view) {
  const float reach = ui.px(34);
  const float size = 2 * reach + ui.px(24);
  const PanelArea area{view.x + view.width - size - ui.px(8),
                       view.y + view.height - size - ui.px(8), size, size};
  ImGui::SetCursorScreenPos({area.x, area.y});
  const ImVec2 center(area.x + size / 2, area.y + size / 2);
  std::array<int, 6> order{0, 1, 2, 3, 4, 5};
  const Camera& camera = ui.state.camera;
  const Vec3 back = camera.back();
  std::sort(order.begin(), order.end(), [&back](int a, int b) {
    return tips()[a].direction.dot(back) < tips()[b].direction.dot(back);
  });
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (const int i : order) {
    const Tip& tip = tips()[i];
    const ImVec2 at(center.x + reach * static_cast<float>(tip.direction.dot(camera.right())),
                    center.y - reach * static_cast<float>(tip.direction.dot(camera.up())));
    const bool has_name = tip.name[0] != '\0';
    const float radius = ui.px(has_name ? 9 : 6);
    ImGui::SetCursorScreenPos({at.x - radius, at.y - radius});
    ImGui::PushID(i);
    if (ImGui::InvisibleButton("tip", {2 * radius, 2 * radius})) ui.state.camera.look(tip.view);
    const bool is_hovered = ImGui::IsItemHovered();
    ImGui::PopID();
    if (has_name) list.AddLine(center, at, colour_of(tip.colour, 0.9F), ui.px(2));
    list.AddCircleFilled(at, radius, colour_of(tip.colour, has_name || is_hovered ? 1 : 0.35F));
    if (!has_name) continue;
    const ImVec2 text = ImGui::CalcTextSize(tip.name);
    list.AddText({at.x - text.x / 2, at.y - text.y / 2 - 1}, IM_COL32(20, 24, 28, 255), tip.name);
  }
}

}  // namespace hewn
