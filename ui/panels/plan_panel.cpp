#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/session/describe.h"
#include "ui/panels/widgets.h"
#include "ui/tools/knife.h"

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

void draw_row_menu(Ui& ui, const PartitionView& view) {
  if (!ImGui::BeginPopupContextItem("row")) return;
  if (ImGui::MenuItem("Select its groups")) {
    select_groups(ui, view.partition.groups, Combine::Replace);
  }
  if (ImGui::MenuItem("Put the selection here", nullptr, false, !ui.state.selected.empty())) {
    const auto refs = refer_to(*ui.session.document().prepared, ui.state.selected);
    static_cast<void>(ui.session.execute(AssignGroups{view.path, refs}));
  }
  draw_reach(ui, view);
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

/// How far the partition has got: found, being searched, failed.
std::string result_of(const Ui& ui, const std::string& name) {
  const auto result = ui.session.current_result();
  if (!result) {
    for (const JobStatus& job : ui.session.jobs()) {
      if (job.name != "searching") continue;
      return job.is_running ? fmt::format("{:.0f} %", 100 * job.share) : "waiting";
    }
    return ui.session.failure().empty() ? "" : "failed";
  }
  for (const PartitionResult& p : result->found.partitions) {
    if (p.name != name) continue;
    const int literals = literal_count(p.answer.tree);
    return fmt::format("{} literal{}", literals, literals == 1 ? "" : "s");
  }
  return {};
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

void draw_partition(Ui& ui, const std::vector<PartitionView>& views, std::size_t row) {
  const PartitionView& view = views[row];
  ImGui::PushID(static_cast<int>(row));
  const float indent = ui.px(14) * static_cast<float>(view.path.size());
  if (indent > 0) ImGui::Indent(indent);
  if (ui.state.colours == ColourMode::Partition || view.path.empty()) {
    dot(ui, ui.state.colours == ColourMode::Partition
                ? to_colour(golden_state(static_cast<int>(row)))
                : ui.theme.faint);
  } else {
    ImGui::PushStyleColor(ImGuiCol_Text, op_colour(view.partition.op));
    ImGui::TextUnformatted(op_sign(view.partition.op));
    ImGui::PopStyleColor();
  }
  ImGui::SameLine(indent + ui.px(24));
  if (ui.state.is_renaming && ui.state.renaming == view.path) {
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
    draw_row_menu(ui, view);
    draw_drag(ui, views, row);
    ImGui::SameLine(indent + ui.px(24));
    const std::string right = fmt::format("{}{}{}", result_of(ui, view.partition.name),
                                          result_of(ui, view.partition.name).empty() ? "" : "   ",
                                          view.partition.groups.size());
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(right.c_str()).x;
    ImGui::TextUnformatted(fitted(view.partition.name, room - ui.px(8)).c_str());
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.faint);
    right_aligned(right);
    ImGui::PopStyleColor();
    draw_eye(ui, view, is_hot, lo, hi);
  }
  if (indent > 0) ImGui::Unindent(indent);
  ImGui::PopID();
}

void draw_partitions(Ui& ui) {
  heading(ui, "Partitions");
  const auto views = ui.session.partitions();
  for (std::size_t i = 0; i < views.size(); ++i) draw_partition(ui, views, i);
  if (views.empty()) {
    faint_text(ui, ui.session.document().is_ready() ? "the plan names groups that are gone"
                                                    : "open a mesh to begin");
    return;
  }
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushTextWrapPos();
  faint_text(ui, "= " + expression_text(ui.session.document().project.root));
  ImGui::PopTextWrapPos();
  ImGui::PopFont();
  const float half = (ImGui::GetContentRegionAvail().x - ui.px(8)) / 2;
  action_button(ui, "New partition", "Add  P", half);
  ImGui::SameLine();
  action_button(ui, "Subtract as partition", "Subtract  Shift+P", half);
  if (views.size() == 1 && ui.session.current_result()) {
    action_button(ui, "Suggest partitions", "Suggest from the tree  Ctrl+G", 2 * half + ui.px(8));
  }
}

void draw_cut(Ui& ui, int index) {
  const CutStep& cut = ui.session.document().project.cuts[index];
  ImGui::PushID(index);
  int axis = -1;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(std::abs(cut.normal[k]) - 1) < 1e-12) axis = k;
  }
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
    ui.state.tool = Tool::Knife;
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
                             : golden_state(g);
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
  ui.state.hovered_groups.clear();
  if (ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows)) ui.state.hovered_literal = -1;
  draw_partitions(ui);
  draw_cuts(ui);
  draw_groups(ui);
  ImGui::End();
}

}  // namespace hewn
