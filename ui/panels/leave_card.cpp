/// Asks before an unsaved plan goes.
#include "ui/panels/widgets.h"

namespace hewn {

void draw_leave_card(Ui& ui, const PanelArea& view) {
  if (!ui.state.leaving) return;
  Leaving& leaving = *ui.state.leaving;
  if (leaving.is_saving && ui.state.file.kind == FileRequest::Kind::None) {
    leaving.is_saving = false;  // saved, or thought better of it
    if (!ui.session.is_modified()) {
      leave_now(ui);
      return;
    }
  }
  if (leaving.is_saving) return;
  begin_card(ui, "leave", view.x + view.width / 2, view.y + ui.px(64), {0.5F, 0});
  ImGui::PushFont(ui.fonts.heading);
  ImGui::TextUnformatted("The plan has changes that are not saved");
  ImGui::PopFont();
  const bool is_quitting = leaving.next.empty();
  faint_text(ui, is_quitting ? "Closing the window would lose them."
                             : "Opening " + leaving.next.filename().string() + " would lose them.");
  if (ImGui::Button("Save")) {
    leaving.is_saving = true;
    action_named(ui, "Save project").run(ui);
  }
  ImGui::SameLine(0, ui.px(8));
  const bool is_going = ImGui::Button("Do not save");
  if (is_quitting && ImGui::IsItemHovered()) {
    ImGui::SetTooltip("Close without saving  [Ctrl+Q again]");
  }
  ImGui::SameLine(0, ui.px(8));
  const bool is_staying = ImGui::Button("Cancel");
  end_card();
  if (is_going) leave_now(ui);
  if (is_staying) ui.state.leaving.reset();
}

}  // namespace hewn
