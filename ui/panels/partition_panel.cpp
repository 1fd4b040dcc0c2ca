#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/session/describe.h"
#include "ui/panels/widgets.h"
#include "ui/view/look.h"

namespace hewn {
namespace {

constexpr const char* kDragType = "partition";

void draw_rename(Ui& ui, const PartitionPath& path) {
  ImGui::SetNextItemWidth(-1);
  ImGui::SetKeyboardFocusHere();
  const bool is_done =
      ImGui::InputText("##name", &ui.state.rename_text,
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  if (!is_done && !ImGui::IsItemDeactivated()) return;
  ui.state.is_renaming = false;
  const PartitionPlan* plan = find_partition(ui.session.document().project.root, path);
  if (is_done && plan && plan->name != ui.state.rename_text) {
    static_cast<void>(ui.session.execute(RenamePartition{path, ui.state.rename_text}));
  }
}

void draw_op_choice(Ui& ui, const PartitionView& view) {
  for (const Op op : {Op::Union, Op::Difference, Op::Intersection}) {
    const std::string label = fmt::format("{}  {}", op_sign(op), name_of(op));
    const bool is_it = view.partition.op == op;
    if (ImGui::MenuItem(label.c_str(), nullptr, is_it) && !is_it) {
      static_cast<void>(ui.session.execute(SetPartitionOp{view.path, op}));
    }
  }
}

void colour_partition(Ui& ui, const PartitionView& view, std::optional<std::uint32_t> colour) {
  if (view.colour == colour) return;
  static_cast<void>(ui.session.execute(ColourPartition{view.path, colour}));
  ui.state.colours = ColourMode::Partition;
}

/// A small choice that goes well together.
void draw_colour_choice(Ui& ui, const PartitionView& view) {
  constexpr int kColours = 12;
  constexpr int kInRow = 6;
  if (!ImGui::BeginMenu("Colour")) return;
  for (int i = 0; i < kColours; ++i) {
    const LabelState c = golden_state(i);
    ImGui::PushID(i);
    if (i % kInRow > 0) ImGui::SameLine(0, ui.px(4));
    if (ImGui::ColorButton("##colour", to_colour(c), ImGuiColorEditFlags_NoTooltip)) {
      colour_partition(ui, view, c.red << 16 | c.green << 8 | c.blue);
      ImGui::CloseCurrentPopup();
    }
    ImGui::PopID();
  }
  if (ImGui::MenuItem("By its place", nullptr, !view.colour)) colour_partition(ui, view, {});
  ImGui::EndMenu();
}

bool is_all_hidden(const Ui& ui, const std::vector<int>& groups) {
  return !groups.empty() && std::all_of(groups.begin(), groups.end(),
                                        [&](int g) { return ui.state.hidden.contains(g); });
}

void flip_visibility(Ui& ui, const std::vector<int>& groups) {
  const bool is_hidden = is_all_hidden(ui, groups);
  for (const int g : groups) {
    if (is_hidden) {
      ui.state.hidden.erase(g);
    } else {
      ui.state.hidden.insert(g);
    }
  }
  std::erase_if(ui.state.selected, [&ui](int g) { return ui.state.hidden.contains(g); });
}

/// What can be seen and picked of a partition.
void draw_reach(Ui& ui, const PartitionView& view) {
  const bool is_hidden = is_all_hidden(ui, view.partition.groups);
  if (ImGui::MenuItem(is_hidden ? "Show" : "Hide")) flip_visibility(ui, view.partition.groups);
  const bool is_locked = ui.state.locked.contains(view.partition.name);
  if (!ImGui::MenuItem("Locked", nullptr, is_locked)) return;
  if (is_locked) {
    ui.state.locked.erase(view.partition.name);
    return;
  }
  ui.state.locked.insert(view.partition.name);
  std::erase_if(ui.state.selected, [&view](int g) {
    return std::binary_search(view.partition.groups.begin(), view.partition.groups.end(), g);
  });
}

void draw_row_menu(Ui& ui, const PartitionView& view, const PartProgress* progress) {
  if (!ImGui::BeginPopupContextItem("row")) return;
  if (progress && !progress->has_ended()) {
    if (ImGui::MenuItem("Stop its search")) ui.session.stop_partition(view.partition.name);
    ImGui::Separator();
  }
  if (ImGui::MenuItem("Select its groups")) {
    select_groups(ui, view.partition.groups, Combine::Replace);
  }
  if (ImGui::MenuItem("Put the selection here", nullptr, false, !ui.state.selected.empty())) {
    const auto refs = refer_to(*ui.session.document().prepared, ui.state.selected);
    static_cast<void>(ui.session.execute(AssignGroups{view.path, refs}));
  }
  draw_reach(ui, view);
  draw_colour_choice(ui, view);
  if (ImGui::MenuItem("Rename")) {
    ui.state.is_renaming = true;
    ui.state.renaming = view.path;
    ui.state.rename_text = view.partition.name;
  }
  if (!view.path.empty()) {
    ImGui::Separator();
    draw_op_choice(ui, view);
    ImGui::Separator();
    const PartitionPath parent(view.path.begin(), view.path.end() - 1);
    if (ImGui::MenuItem("Move up", nullptr, false, view.path.back() > 0)) {
      static_cast<void>(ui.session.execute(MovePartition{view.path, parent, view.path.back() - 1}));
      ui.state.active_partition.clear();
    }
    const PartitionPlan* siblings = find_partition(ui.session.document().project.root, parent);
    const int last = siblings ? static_cast<int>(siblings->children.size()) - 1 : 0;
    if (ImGui::MenuItem("Move down", nullptr, false, view.path.back() < last)) {
      static_cast<void>(ui.session.execute(MovePartition{view.path, parent, view.path.back() + 1}));
      ui.state.active_partition.clear();
    }
    if (ImGui::MenuItem("Remove", "Del")) {
      static_cast<void>(ui.session.execute(RemovePartition{view.path}));
      ui.state.active_partition.clear();
    }
  }
  ImGui::EndPopup();
}

void draw_drag(Ui& ui, const std::vector<PartitionView>& views, std::size_t row) {
  const PartitionView& view = views[row];
  if (!view.path.empty() && ImGui::BeginDragDropSource()) {
    ImGui::SetDragDropPayload(kDragType, &row, sizeof row);
    ImGui::TextUnformatted(view.partition.name.c_str());
    ImGui::EndDragDropSource();
  }
  if (!ImGui::BeginDragDropTarget()) return;
  if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(kDragType)) {
    const std::size_t from = *static_cast<const std::size_t*>(payload->Data);
    if (from < views.size() && from != row) {
      static_cast<void>(ui.session.execute(MovePartition{views[from].path, view.path, 1000}));
      ui.state.active_partition.clear();
    }
  }
  ImGui::EndDragDropTarget();
}

/// What is known of the partition's search; null: nothing.
const PartProgress* progress_of(const std::vector<PartProgress>& all, const std::string& name) {
  const auto it =
      std::find_if(all.begin(), all.end(), [&name](const auto& p) { return p.name == name; });
  return it == all.end() ? nullptr : &*it;
}

/// Short, for the row's right end.
std::string progress_text(const PartProgress& p) {
  switch (p.state) {
    case PartProgress::State::Waiting:
      return "waiting";
    case PartProgress::State::Running:
      return fmt::format("{:.0f} %", 100 * p.share);
    case PartProgress::State::Done:
      return fmt::format("{} literal{}", p.literals, p.literals == 1 ? "" : "s");
    case PartProgress::State::Failed:
      return "failed";
    case PartProgress::State::Stopped:
      break;
  }
  return "stopped";
}

/// In full, for the row's tooltip.
std::string progress_details(const PartProgress& p) {
  switch (p.state) {
    case PartProgress::State::Waiting:
      return "Waits for its turn.";
    case PartProgress::State::Running:
      return fmt::format("Searching: {}. Right click to stop it alone.", p.stage);
    case PartProgress::State::Done:
      return fmt::format("{} literals, size {}; {} % of fresh points are wrong{}.", p.literals,
                         p.size, short_number(100 * p.error),
                         p.seconds > 0 ? fmt::format("; {:.2f} s", p.seconds) : "");
    case PartProgress::State::Failed:
      return p.reason;
    case PartProgress::State::Stopped:
      break;
  }
  return "Stopped before a tree was found.";
}

/// Under a row: a bar while its search runs, the reason when it failed.
void draw_progress(const Ui& ui, const PartProgress& p, const ImVec2& lo, const ImVec2& hi) {
  if (p.state == PartProgress::State::Running) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float right = lo.x + (hi.x - lo.x) * static_cast<float>(p.share);
    list.AddRectFilled({lo.x, hi.y - ui.px(2)}, hi, ImGui::GetColorU32(ui.theme.line));
    list.AddRectFilled({lo.x, hi.y - ui.px(2)}, {right, hi.y}, ImGui::GetColorU32(ui.theme.accent));
  }
  if (p.state != PartProgress::State::Failed) return;
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.bad);
  ImGui::PushTextWrapPos();
  ImGui::TextUnformatted(p.reason.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

/// Stop what runs, or try again what came to nothing.
void draw_search_buttons(Ui& ui, const std::vector<PartProgress>& all) {
  using State = PartProgress::State;
  const auto any = [&all](auto... states) {
    return std::any_of(all.begin(), all.end(),
                       [&](const PartProgress& p) { return ((p.state == states) || ...); });
  };
  const float width = ImGui::GetContentRegionAvail().x;
  if (any(State::Running, State::Waiting)) {
    action_button(ui, "Stop all jobs", with_icon(ui, icon::kStop, "Stop  Ctrl+.").c_str(), width);
  } else if (any(State::Failed, State::Stopped)) {
    action_button(ui, "Reconstruct", with_icon(ui, icon::kPlay, "Try again  Ctrl+R").c_str(),
                  width);
  }
}

/// The eye at the right end of a row; bright while the row is under the mouse.
void draw_eye(Ui& ui, const PartitionView& view, bool is_hot, const ImVec2& lo, const ImVec2& hi) {
  const bool is_hidden = is_all_hidden(ui, view.partition.groups);
  const bool is_locked = ui.state.locked.contains(view.partition.name);
  if (!ui.fonts.has_icons || !(is_hot || is_hidden || is_locked)) return;
  std::string signs = is_hidden ? icon::kEyeOff : icon::kEye;
  if (is_locked) signs = std::string(icon::kLock) + " " + signs;
  const float width = ImGui::CalcTextSize(signs.c_str()).x;
  const float x = hi.x - width - ui.px(4);
  ImGui::GetWindowDrawList()->AddRectFilled({x - ui.px(4), lo.y}, hi,
                                            ImGui::GetColorU32(ui.theme.raised), ui.px(4));
  ImGui::GetWindowDrawList()->AddText({x, lo.y + ui.px(1)}, ImGui::GetColorU32(ui.theme.text),
                                      signs.c_str());
  const bool is_over = ImGui::IsMouseHoveringRect({hi.x - ui.px(24), lo.y}, hi);
  if (is_over) ImGui::SetTooltip("%s", is_hidden ? "Show its groups." : "Hide its groups.");
  if (is_over && ImGui::IsMouseClicked(0)) flip_visibility(ui, view.partition.groups);
}

/// The operation, and the colour where partitions show one; then goes to where the name begins.
void draw_sign(const Ui& ui, const PartitionView& view, std::size_t row, float indent) {
  const bool has_colour = ui.state.colours == ColourMode::Partition;
  const ImVec4 colour = has_colour ? to_colour(partition_colour(view, row)) : ui.theme.faint;
  ImGui::SameLine(indent + ui.px(12));
  if (view.path.empty()) {
    dot(ui, colour);
    ImGui::SameLine(indent + ui.px(28));
    return;
  }
  ImGui::PushStyleColor(ImGuiCol_Text, op_colour(view.partition.op));
  ImGui::TextUnformatted(op_sign(view.partition.op));
  ImGui::PopStyleColor();
  ImGui::SameLine(indent + ui.px(28));
  if (!has_colour) return;
  dot(ui, colour);
  ImGui::SameLine(indent + ui.px(44));
}

void draw_partition(Ui& ui, const std::vector<PartitionView>& views, std::size_t row,
                    const std::vector<PartProgress>& all) {
  const PartitionView& view = views[row];
  ImGui::PushID(static_cast<int>(row));
  const float indent = ui.px(14) * static_cast<float>(view.path.size());
  if (indent > 0) ImGui::Indent(indent);
  if (ui.state.is_renaming && ui.state.renaming == view.path) {
    ImGui::Dummy({});  // what the sign stands beside
    draw_sign(ui, view, row, indent);
    draw_rename(ui, view.path);
  } else {
    const bool is_active = ui.state.active_partition == view.path;
    if (ImGui::Selectable("##row", is_active, ImGuiSelectableFlags_AllowDoubleClick)) {
      ui.state.active_partition = view.path;
      if (ImGui::IsMouseDoubleClicked(0)) {
        select_groups(ui, view.partition.groups, Combine::Replace);
      }
    }
    const bool is_hot = ImGui::IsItemHovered();
    const ImVec2 lo = ImGui::GetItemRectMin();
    const ImVec2 hi = ImGui::GetItemRectMax();
    if (is_hot) ui.state.hovered_groups = view.partition.groups;
    const PartProgress* progress = progress_of(all, view.partition.name);
    draw_row_menu(ui, view, progress);
    draw_drag(ui, views, row);
    draw_sign(ui, view, row, indent);
    const std::string right = fmt::format("{}{}{:>4}", progress ? progress_text(*progress) : "",
                                          progress ? "   " : "", view.partition.groups.size());
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(right.c_str()).x;
    ImGui::TextUnformatted(fitted(view.partition.name, room - ui.px(8)).c_str());
    ImGui::SameLine();
    const bool has_failed = progress && progress->state == PartProgress::State::Failed;
    ImGui::PushStyleColor(ImGuiCol_Text, has_failed ? ui.theme.bad : ui.theme.faint);
    right_aligned(right);
    ImGui::PopStyleColor();
    if (is_hot && progress) ImGui::SetTooltip("%s", progress_details(*progress).c_str());
    draw_eye(ui, view, is_hot, lo, hi);
    if (progress) draw_progress(ui, *progress, lo, hi);
  }
  if (indent > 0) ImGui::Unindent(indent);
  ImGui::PopID();
}

/// The expression with the signs that stand beside the rows.
std::string with_signs(const std::string& expression) {
  std::string text;
  for (std::size_t i = 0; i < expression.size(); ++i) {
    const bool is_sign =
        i > 0 && i + 1 < expression.size() && expression[i - 1] == ' ' && expression[i + 1] == ' ';
    if (is_sign && expression[i] == '-') {
      text += op_sign(Op::Difference);
    } else if (is_sign && expression[i] == '*') {
      text += op_sign(Op::Intersection);
    } else {
      text += expression[i];
    }
  }
  return text;
}

}  // namespace

void draw_partitions(Ui& ui) {
  heading(ui, "Partitions");
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.faint);
  right_aligned("groups");
  ImGui::PopStyleColor();
  const auto views = ui.session.partitions();
  const auto progress = ui.session.partition_progress();
  for (std::size_t i = 0; i < views.size(); ++i) draw_partition(ui, views, i, progress);
  if (views.empty()) {
    faint_text(ui, ui.session.document().is_ready() ? "the plan names groups that are gone"
                                                    : "open a mesh to begin");
    return;
  }
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushTextWrapPos();
  faint_text(ui, "= " + with_signs(expression_text(ui.session.document().project.root)));
  ImGui::PopTextWrapPos();
  ImGui::PopFont();
  draw_search_buttons(ui, progress);
  const float half = (ImGui::GetContentRegionAvail().x - ui.px(8)) / 2;
  action_button(ui, "New partition", "Add  P", half);
  ImGui::SameLine();
  action_button(ui, "Subtract as partition", "Subtract  Shift+P", half);
  if (views.size() == 1 && ui.session.current_result()) {
    action_button(ui, "Suggest partitions", "Suggest from the tree  Ctrl+G", 2 * half + ui.px(8));
  }
}

}  // namespace hewn
