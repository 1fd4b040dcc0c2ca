#include "ui/actions.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "core/session/recovery.h"
#include "core/session/suggest.h"
#include "ui/tools/section.h"

namespace hewn {
namespace {

constexpr int kEscape = 256, kEnter = 257, kDelete = 261, kF1 = 290, kF12 = 301;

bool always(const Ui&) { return true; }
bool has_mesh(const Ui& ui) { return ui.session.document().is_ready(); }
bool has_selection(const Ui& ui) { return has_mesh(ui) && !ui.state.selected.empty(); }
bool has_result(const Ui& ui) { return ui.session.shown_result() != nullptr; }
bool has_view(const Ui& ui) { return ui.session.result_view() != nullptr; }

std::vector<int> all_groups(const Ui& ui) {
  std::vector<int> all(ui.session.document().prepared->segmentation.groups.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void request_file(Ui& ui, FileRequest::Kind kind) {
  const std::filesystem::path& mesh = ui.session.document().project.mesh;
  std::error_code ignored;
  FileRequest& file = ui.state.file;
  file.kind = kind;
  file.has_focus = false;
  if (file.folder.empty()) {
    file.folder = mesh.empty() ? std::filesystem::current_path(ignored)
                               : std::filesystem::absolute(mesh, ignored).parent_path();
  }
  file.name.clear();
  if (kind == FileRequest::Kind::SaveProject) file.name = mesh.stem().string() + ".json";
  if (kind == FileRequest::Kind::Export) file.name = mesh.stem().string() + ".scad";
}

void save(Ui& ui) {
  if (ui.session.project_path().empty()) {
    request_file(ui, FileRequest::Kind::SaveProject);
  } else {
    static_cast<void>(ui.session.execute(SaveProject{ui.session.project_path()}));
  }
}

void make_partition(Ui& ui, Op op) {
  const Document& document = ui.session.document();
  AddPartition command;
  command.parent = ui.state.active_partition;
  command.op = op;
  command.groups = refer_to(*document.prepared, ui.state.selected);
  if (!find_partition(document.project.root, command.parent)) command.parent.clear();
  if (ui.session.execute(command)) ui.state.selected.clear();
}

void select_similar_groups(Ui& ui, Likeness likeness) {
  ui.state.selected = select_like(*ui.session.document().prepared, ui.state.selected, likeness);
}

void hide_others(Ui& ui) {
  for (const int g : all_groups(ui)) {
    if (!std::binary_search(ui.state.selected.begin(), ui.state.selected.end(), g)) {
      ui.state.hidden.insert(g);
    }
  }
}

void leave(Ui& ui) {
  StudioState& state = ui.state;
  const bool is_open = state.shows_palette || state.shows_keys || state.shows_settings ||
                       state.shows_log || state.leaving ||
                       state.file.kind != FileRequest::Kind::None;
  if (is_open) {
    state.shows_palette = state.shows_keys = state.shows_settings = state.shows_log = false;
    state.leaving.reset();
    state.file.kind = FileRequest::Kind::None;
  } else if (state.tool != Tool::Select) {
    state.take_up(Tool::Select);
  } else {
    state.selected.clear();
    state.picked_literal = state.picked_node = -1;
  }
}

void confirm_cut(Ui& ui) {
  if (!ui.state.knife.plane) return;
  const SnappedPlane& plane = *ui.state.knife.plane;
  const int placed = ui.state.knife.placed_cut;
  Result<void> done;
  if (placed >= 0) {
    done = ui.session.execute(MoveCut{placed, plane.normal, plane.offset});
  } else {
    CutStep cut{plane.normal, plane.offset, {}};
    cut.groups = refer_to(*ui.session.document().prepared, ui.state.selected);
    done = ui.session.execute(AddCut{cut});
  }
  if (done) {
    ui.state.take_up(Tool::Select);
    ui.state.selected.clear();
  }
}

void suggest(Ui& ui) {
  auto plan = suggest_partitions(ui.session.document(), ui.session.current_result()->found.tree);
  if (plan) {
    static_cast<void>(ui.session.execute(SetPlan{plan_text(*plan)}));
    ui.state.colours = ColourMode::Partition;
  } else {
    ui.session.notify(Severity::Info, plan.error().message);
  }
}

bool open_now(Ui& ui, const std::filesystem::path& path) {
  const bool is_open = ui.session.execute(OpenFile{path}).has_value();
  if (is_open) reset_view(ui.state);
  return is_open;
}

void open_sample(Ui& ui) { request_open(ui, ui.state.sample); }

void look(Ui& ui, StandardView view) { ui.state.camera.look(view); }

template <class Command>
std::function<void(Ui&)> command() {
  return [](Ui& ui) { static_cast<void>(ui.session.execute(Command{})); };
}

/// Whoever asks for a tree wants to see it; until there is one the view keeps the input.
void reconstruct(Ui& ui) {
  if (!ui.session.execute(Reconstruct{})) return;
  if (ui.state.show == ShowMode::Input) ui.state.show = ShowMode::Result;
}

/// Measures the mesh: that is what is known.
void measure(Ui& ui) {
  ui.state.take_up(Tool::Measure);
  ui.state.show = ShowMode::Input;
}

std::function<void(Ui&)> take_up(Tool tool) {
  return [tool](Ui& ui) { ui.state.take_up(tool); };
}

template <class T>
std::function<void(Ui&)> put(T StudioState::*member, T value) {
  return [member, value](Ui& ui) { ui.state.*member = value; };
}

std::function<void(Ui&)> flip(bool StudioState::*member) {
  return [member](Ui& ui) { ui.state.*member = !(ui.state.*member); };
}

void add_file_actions(std::vector<Action>& out) {
  using Kind = FileRequest::Kind;
  out.push_back({"File", "Open", 'O', kCtrl, "Open a mesh or a project file.", always,
                 [](Ui& ui) { request_file(ui, Kind::Open); }});
  out.push_back({"File", "Save project", 'S', kCtrl,
                 "Save the plan: cuts, merges, partitions and settings.", has_mesh, save});
  out.push_back({"File", "Save project as", 'S', kCtrl | kShift,
                 "Save the plan under another name.", has_mesh,
                 [](Ui& ui) { request_file(ui, Kind::SaveProject); }});
  out.push_back({"File", "Export the tree", 'E', kCtrl,
                 "Write the tree as OpenSCAD, JSON, STL, OFF, OBJ, PLY or STEP.", has_mesh,
                 [](Ui& ui) { request_file(ui, Kind::Export); }});
  out.push_back({"File", "Open in OpenSCAD", 'O', kCtrl | kShift,
                 "Export the tree into a temporary file and open it in OpenSCAD.",
                 [](const Ui& ui) { return ui.state.has_openscad && has_mesh(ui); },
                 put(&StudioState::wants_openscad, true)});
  out.push_back({"File", "Picture of the window", kF12, 0,
                 "Write a PNG of the window into the working folder.", always,
                 put(&StudioState::wants_picture, true)});
  out.push_back({"File", "Quit", 'Q', kCtrl, "Close the window.", always, request_quit});
}

void add_edit_actions(std::vector<Action>& out) {
  out.push_back({"Edit", "Undo", 'Z', kCtrl, "Take the last command back.",
                 [](const Ui& ui) { return ui.session.history().can_undo(); }, command<Undo>()});
  out.push_back({"Edit", "Redo", 'Z', kCtrl | kShift, "Do again what was undone.",
                 [](const Ui& ui) { return ui.session.history().can_redo(); }, command<Redo>()});
  out.push_back({"Edit", "Knife", 'K', 0,
                 "Drag a line across the part to cut the selected groups, or all.", has_mesh,
                 take_up(Tool::Knife)});
  out.push_back({"Edit", "Confirm the cut", kEnter, 0, "Cut along the plane shown.",
                 [](const Ui& ui) { return ui.state.knife.plane.has_value(); }, confirm_cut});
  out.push_back({"Edit", "Merge groups", 'M', 0, "Make one group of the selected ones.",
                 [](const Ui& ui) { return ui.state.selected.size() > 1 && has_mesh(ui); },
                 [](Ui& ui) {
                   const auto refs = refer_to(*ui.session.document().prepared, ui.state.selected);
                   if (ui.session.execute(MergeGroups{refs})) ui.state.selected.clear();
                 }});
  out.push_back({"Edit", "New partition", 'P', 0,
                 "Make the selected groups a partition that is added (union).", has_selection,
                 [](Ui& ui) { make_partition(ui, Op::Union); }});
  out.push_back({"Edit", "Subtract as partition", 'P', kShift,
                 "Make the selected groups a partition that is taken away (difference).",
                 has_selection, [](Ui& ui) { make_partition(ui, Op::Difference); }});
  out.push_back(
      {"Edit", "Remove partition", kDelete, 0, "Give the groups of the active partition back.",
       [](const Ui& ui) { return !ui.state.active_partition.empty(); },
       [](Ui& ui) {
         static_cast<void>(ui.session.execute(RemovePartition{ui.state.active_partition}));
         ui.state.active_partition.clear();
       }});
  out.push_back({"Edit", "Suggest partitions", 'G', kCtrl,
                 "Make partitions from the outermost terms of the tree that was found.",
                 [](const Ui& ui) {
                   return ui.session.current_result() &&
                          ui.session.document().project.root.children.empty();
                 },
                 suggest});
  out.push_back(
      {"Edit", "Reconstruct", 'R', kCtrl, "Find the tree of the plan.", has_mesh, reconstruct});
  out.push_back({"Edit", "Settings", ',', kCtrl, "Tune how groups and trees are found.", has_mesh,
                 flip(&StudioState::shows_settings)});
  out.push_back({"Edit", "Live reconstruction", 'L', kCtrl,
                 "Find the tree anew after every change of the plan.", always,
                 [](Ui& ui) { ui.session.set_live(!ui.session.is_live()); }});
  out.push_back({"Edit", "Search variants", 'R', kCtrl | kShift,
                 "Search with six other settings, for a choice of trees.", has_mesh,
                 [](Ui& ui) { ui.session.search_variants(); }});
  out.push_back({"Edit", "Stop all jobs", '.', kCtrl, "Stop what runs and what waits.",
                 [](const Ui& ui) { return ui.session.is_busy(); },
                 [](Ui& ui) { ui.session.cancel_jobs(); }});
}

void add_select_actions(std::vector<Action>& out) {
  out.push_back({"Select", "Select all", 'A', kCtrl, "Select every group that is shown.", has_mesh,
                 [](Ui& ui) { select_groups(ui, all_groups(ui), Combine::Replace); }});
  out.push_back({"Select", "Clear or leave", kEscape, 0,
                 "Close what is open, leave the tool, or select nothing.", always, leave});
  out.push_back({"Select", "Invert selection", 'I', kCtrl, "Select what is not selected.", has_mesh,
                 [](Ui& ui) { select_groups(ui, all_groups(ui), Combine::Toggle); }});
  out.push_back({"Select", "Box selection", 'B', 0,
                 "Drag a box: left to right takes what is inside, right to left what it touches.",
                 has_mesh, take_up(Tool::Box)});
  out.push_back({"Select", "Lasso selection", 'L', 0,
                 "Draw around groups: takes those that lie in it for the most part.", has_mesh,
                 take_up(Tool::Lasso)});
  out.push_back({"Select", "Same kind", 'S', 0, "Add all groups of the same kind and side.",
                 has_selection, [](Ui& ui) { select_similar_groups(ui, Likeness::Kind); }});
  out.push_back({"Select", "Same radius", 'S', kShift, "Add groups of the same kind and radius.",
                 has_selection, [](Ui& ui) { select_similar_groups(ui, Likeness::Radius); }});
  out.push_back({"Select", "Coaxial", 'C', kShift, "Add groups of the same kind and axis.",
                 has_selection, [](Ui& ui) { select_similar_groups(ui, Likeness::Coaxial); }});
  out.push_back({"Select", "Parallel", 'L', kShift, "Add groups of the same kind and direction.",
                 has_selection, [](Ui& ui) { select_similar_groups(ui, Likeness::Parallel); }});
  out.push_back({"Select", "Grow", '=', 0, "Add the neighbours of the selected groups.",
                 has_selection, [](Ui& ui) {
                   select_groups(ui, grown(*ui.session.document().prepared, ui.state.selected),
                                 Combine::Replace);
                 }});
  out.push_back({"Select", "Shrink", '-', 0, "Take groups at the rim out of the selection.",
                 has_selection, [](Ui& ui) {
                   ui.state.selected = shrunk(*ui.session.document().prepared, ui.state.selected);
                 }});
}

void add_look_actions(std::vector<Action>& out) {
  out.push_back({"View", "Fit", 'F', 0, "Show the whole part.", has_mesh,
                 put(&StudioState::wants_fit, true)});
  out.push_back({"View", "Front", '1', 0, "Look along y.", always,
                 [](Ui& ui) { look(ui, StandardView::Front); }});
  out.push_back({"View", "Right side", '3', 0, "Look along x.", always,
                 [](Ui& ui) { look(ui, StandardView::Right); }});
  out.push_back({"View", "Top", '7', 0, "Look down along z.", always,
                 [](Ui& ui) { look(ui, StandardView::Top); }});
  out.push_back({"View", "Oblique", '0', 0, "Look from the front, right and above.", always,
                 [](Ui& ui) { look(ui, StandardView::Oblique); }});
  out.push_back({"View", "Perspective", '5', 0, "Switch between perspective and parallel rays.",
                 always,
                 [](Ui& ui) { ui.state.camera.is_perspective = !ui.state.camera.is_perspective; }});
  out.push_back(
      {"View", "X-ray", 'X', 0, "See through the part.", always, flip(&StudioState::is_xray)});
  out.push_back({"View", "Wireframe", 'W', 0, "Show the triangles.", always,
                 flip(&StudioState::is_wireframe)});
  out.push_back({"View", "Section", 'C', 0, "Cut the view open across x, y, z in turn.", has_mesh,
                 next_section});
  out.push_back({"View", "Measure", 'M', kShift,
                 "Click two faces, or corners, for distances, angles and radii.", has_mesh,
                 measure});
  out.push_back({"View", "Hide", 'H', 0, "Hide the selected groups.", has_selection, [](Ui& ui) {
                   ui.state.hidden.insert(ui.state.selected.begin(), ui.state.selected.end());
                   ui.state.selected.clear();
                 }});
  out.push_back({"View", "Isolate", 'H', kShift, "Hide all but the selected groups.", has_selection,
                 hide_others});
  out.push_back({"View", "Show all", 'H', kAlt, "Show hidden groups again.", always,
                 [](Ui& ui) { ui.state.hidden.clear(); }});
}

void add_show_actions(std::vector<Action>& out) {
  const auto colour = [&out](const char* title, int key, const char* help, ColourMode mode) {
    out.push_back({"View", title, key, kCtrl, help,
                   [mode](const Ui& ui) { return mode != ColourMode::Deviation || has_view(ui); },
                   put(&StudioState::colours, mode)});
  };
  colour("Colour by group", '1', "One colour for each face group.", ColourMode::Group);
  colour("Colour by type", '2', "One colour for each kind of surface.", ColourMode::Kind);
  colour("Colour by partition", '3', "One colour for each partition.", ColourMode::Partition);
  colour("Colour by deviation", '4', "How far the input is from the result.",
         ColourMode::Deviation);
  out.push_back({"View", "Show input", 'I', 0, "Show the mesh.", has_mesh,
                 put(&StudioState::show, ShowMode::Input)});
  out.push_back({"View", "Show result", 'R', 0, "Show the solid of the tree.", has_result,
                 put(&StudioState::show, ShowMode::Result)});
  out.push_back({"View", "Show overlay", 'O', 0, "Show the result inside the glassy mesh.",
                 has_result, put(&StudioState::show, ShowMode::Overlay)});
  out.push_back({"View", "Show difference", 'D', 0,
                 "Show only where mesh and result differ by more than the tolerance.", has_view,
                 put(&StudioState::show, ShowMode::Difference)});
  out.push_back({"View", "Exact result", 'E', 0,
                 "Draw the result ray by ray: automatically, always, or never.", has_result,
                 [](Ui& ui) {
                   const int next = (static_cast<int>(ui.state.exact) + 1) % 3;
                   ui.state.exact = static_cast<ExactMode>(next);
                 }});
  out.push_back({"View", "Plan panel", 'B', kCtrl, "Show or hide the plan on the left.", always,
                 flip(&StudioState::shows_plan)});
  out.push_back({"View", "Result panel", 'B', kCtrl | kShift,
                 "Show or hide the result on the right.", always,
                 flip(&StudioState::shows_result)});
  out.push_back({"View", "Light theme", 'T', kCtrl, "Switch between the dark and light theme.",
                 always, flip(&StudioState::is_light)});
  out.push_back(
      {"Help", "Find a command", 'K', kCtrl, "Find any command by name.", always, [](Ui& ui) {
         ui.state.shows_palette = true;
         ui.state.palette_text.clear();
         ui.state.palette_at = 0;
       }});
  out.push_back({"Help", "Log", 'J', kCtrl, "Show what was done and said in this session.", always,
                 flip(&StudioState::shows_log)});
  out.push_back({"Help", "Keys", kF1, 0, "List all keys.", always, flip(&StudioState::shows_keys)});
  out.push_back({"Help", "Open the sample part", 0, 0, "Open a small part to try things on.",
                 [](const Ui& ui) { return !ui.state.sample.empty(); }, open_sample});
  out.push_back({"Help", "First steps", 0, 0, "Show the four hints again.", always, [](Ui& ui) {
                   ui.state.shows_hints = true;
                   ui.state.hint = 0;
                 }});
}

const char* key_name(int key) {
  static constexpr const char* kLetters[] = {"A", "B", "C", "D", "E", "F", "G", "H", "I",
                                             "J", "K", "L", "M", "N", "O", "P", "Q", "R",
                                             "S", "T", "U", "V", "W", "X", "Y", "Z"};
  static constexpr const char* kDigits[] = {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"};
  if (key >= 'A' && key <= 'Z') return kLetters[key - 'A'];
  if (key >= '0' && key <= '9') return kDigits[key - '0'];
  switch (key) {
    case '=':
      return "+";
    case '-':
      return "-";
    case '.':
      return ".";
    case ',':
      return ",";
    case kEscape:
      return "Esc";
    case kEnter:
      return "Enter";
    case kDelete:
      return "Del";
    case kF1:
      return "F1";
    case kF12:
      return "F12";
    default:
      return "";
  }
}

}  // namespace

std::vector<Action> make_actions() {
  std::vector<Action> out;
  add_file_actions(out);
  add_edit_actions(out);
  add_select_actions(out);
  add_look_actions(out);
  add_show_actions(out);
  return out;
}

std::string shortcut_text(const Action& action) {
  if (action.key == 0) return {};
  std::string text;
  if (action.mods & kCtrl) text += "Ctrl+";
  if (action.mods & kAlt) text += "Alt+";
  if (action.mods & kShift) text += "Shift+";
  return text + key_name(action.key);
}

bool run_shortcut(Ui& ui, int key, int mods) {
  constexpr int kKeypadEnter = 335;
  if (key == kKeypadEnter) key = kEnter;
  for (const Action& action : *ui.actions) {
    const bool is_it = action.key == key && action.mods == (mods & (kShift | kCtrl | kAlt));
    if (!is_it || !action.is_enabled(ui)) continue;
    action.run(ui);
    return true;
  }
  return false;
}

const Action& action_named(const Ui& ui, const char* title) {
  const auto it = std::find_if(ui.actions->begin(), ui.actions->end(), [title](const Action& a) {
    return std::strcmp(a.title, title) == 0;
  });
  return *it;
}

void select_groups(Ui& ui, const std::vector<int>& groups, Combine how) {
  std::set<int> barred = ui.state.hidden;
  for (const PartitionView& view : ui.session.partitions()) {
    if (!ui.state.locked.contains(view.partition.name)) continue;
    barred.insert(view.partition.groups.begin(), view.partition.groups.end());
  }
  std::vector<int> shown;
  for (const int g : groups) {
    if (!barred.contains(g)) shown.push_back(g);
  }
  ui.state.selected = combined(ui.state.selected, shown, how);
}

bool request_open(Ui& ui, const std::filesystem::path& path) {
  if (ui.session.is_modified()) {
    ui.state.leaving = Leaving{path};
    return true;
  }
  return open_now(ui, path);
}

void request_quit(Ui& ui) {
  const bool was_asked = ui.state.leaving && ui.state.leaving->next.empty();
  if (was_asked || !ui.session.is_modified()) {
    ui.state.wants_close = true;
  } else {
    ui.state.leaving = Leaving{};
  }
}

void leave_now(Ui& ui) {
  const std::filesystem::path next = ui.state.leaving->next;
  ui.state.leaving.reset();
  if (next.empty()) {
    ui.state.wants_close = true;
  } else {
    open_now(ui, next);
  }
}

void reset_view(StudioState& state) {
  state.selected.clear();
  state.hidden.clear();
  state.locked.clear();
  state.active_partition.clear();
  state.take_up(Tool::Select);
  state.section.reset();
  state.picked_literal = state.picked_node = state.hovered_node = -1;
  state.show = ShowMode::Input;
  state.wants_fit = true;
}

}  // namespace hewn
