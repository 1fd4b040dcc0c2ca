#include "ui/tools/marks.h"

namespace hewn {

void draw_label(const Ui& ui, const ImVec2& beside, const std::string& text) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 at(beside.x + ui.px(16), beside.y + ui.px(12));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  list.AddRectFilled({at.x - ui.px(6), at.y - ui.px(3)},
                     {at.x + size.x + ui.px(6), at.y + size.y + ui.px(3)},
                     ImGui::GetColorU32(ui.theme.raised), ui.px(4));
  list.AddText(at, ImGui::GetColorU32(ui.theme.text), text.c_str());
}

}  // namespace hewn
