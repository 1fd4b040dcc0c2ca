#include "ui/view/viewport.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "ui/actions.h"
#include "ui/tools/knife.h"

namespace hewn {
namespace {

constexpr float kDragStart = 4;         // pixels before a press becomes a drag
constexpr double kSlowPicture_ms = 25;  // slower: no antialiasing while the camera moves

Combine combination() {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyShift && io.KeyCtrl) return Combine::Remove;
  if (io.KeyShift) return Combine::Add;
  return io.KeyCtrl ? Combine::Toggle : Combine::Replace;
}

bool picks_groups(const Scene& scene) {
  return !scene.items.empty() && scene.items[0].slot == MeshSlot::Input;
}

/// Groups with pixels in the box; `must_enclose`: and none outside.
std::vector<int> groups_in(const IdImage& ids, int x0, int y0, int x1, int y1, bool must_enclose) {
  std::vector<int> inside, outside;
  const auto count = [](std::vector<int>& counts, int label) {
    if (static_cast<std::size_t>(label) >= counts.size()) counts.resize(label + 1, 0);
    ++counts[label];
  };
  for (int y = 0; y < ids.height; ++y) {
    for (int x = 0; x < ids.width; ++x) {
      const int label = ids.at(x, y);
      if (label < 0) continue;
      const bool is_in = x >= x0 && x <= x1 && y >= y0 && y <= y1;
      count(is_in ? inside : outside, label);
    }
  }
  outside.resize(std::max(inside.size(), outside.size()), 0);
  std::vector<int> groups;
  for (std::size_t g = 0; g < inside.size(); ++g) {
    if (inside[g] > 0 && (!must_enclose || outside[g] == 0)) groups.push_back(static_cast<int>(g));
  }
  return groups;
}

}  // namespace

void Viewport::sync_meshes(Ui& ui) {
  const auto input = ui.session.display();
  if (input != input_) {
    const bool is_first = !input_ || !input || input_->bounds.lo != input->bounds.lo ||
                          input_->bounds.hi != input->bounds.hi;
    if (input && is_first) ui.state.wants_fit = true;
    input_ = input;
    engine_.show_mesh(MeshSlot::Input, input_.get());
    states_.clear();
    must_draw_ = true;
    ui.state.hovered = -1;
    const int count = input ? input->labels : 0;
    std::erase_if(ui.state.selected, [count](int g) { return g >= count; });
    std::erase_if(ui.state.hidden, [count](int g) { return g >= count; });
  }
  const auto result = ui.session.result_view();
  if (result != result_) {
    result_ = result;
    engine_.show_mesh(MeshSlot::Surface, result ? &result->surface : nullptr);
    engine_.show_mesh(MeshSlot::Measured, result ? &result->input : nullptr);
    literal_states_.clear();
    must_draw_ = true;
    ui.state.hovered_literal = -1;
    const auto shown = ui.session.shown_result();
    const int literals = shown ? static_cast<int>(shown->found.tree.literals.size()) : 0;
    if (ui.state.picked_literal >= literals) ui.state.picked_literal = -1;
  }
}

void Viewport::sync_states(Ui& ui) {
  auto states = group_states(ui);
  if (states != states_) {
    states_ = std::move(states);
    engine_.set_states(MeshSlot::Input, states_);
    must_draw_ = true;
  }
  auto literals = literal_states(ui);
  if (literals != literal_states_) {
    literal_states_ = std::move(literals);
    engine_.set_states(MeshSlot::Surface, literal_states_);
    engine_.set_states(MeshSlot::Measured, literal_states_);
    must_draw_ = true;
  }
}

void Viewport::draw(Ui& ui, const ViewArea& area) {
  sync_meshes(ui);
  if (ui.state.wants_fit && ui.session.document().is_ready()) {
    ui.state.wants_fit = false;
    ui.state.camera.fit(Vec3::Zero(), ui.session.document().prepared->mesh->diagonal() / 2);
  }
  const bool is_hovered = ImGui::IsWindowHovered() && !ImGui::IsAnyItemHovered();
  follow_mouse(ui, area, is_hovered);
  sync_states(ui);
  const Scene scene = build_scene(ui, area);
  const bool is_slow = frame_cost_ms_ > kSlowPicture_ms;
  const int samples = is_moving() && is_slow ? 1 : 4;
  must_draw_ |= !(scene == drawn_) || samples != drawn_samples_ || area.width != drawn_width_ ||
                area.height != drawn_height_;
  if (must_draw_) {
    const auto start = std::chrono::steady_clock::now();
    picture_ =
        engine_.draw(scene, static_cast<int>(area.width), static_cast<int>(area.height), samples);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    if (samples == 4) frame_cost_ms_ = took.count();
    drawn_ = scene;
    drawn_samples_ = samples;
    drawn_width_ = area.width;
    drawn_height_ = area.height;
    must_draw_ = false;
    has_ids_ = false;
  }
  if (picture_ != 0) {
    ImGui::GetWindowDrawList()->AddImage(
        reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture_)),  // NOLINT: its type
        {area.x, area.y}, {area.x + area.width, area.y + area.height}, {0, 1}, {1, 0});
  }
  draw_rubber_band(ui);
}

const IdImage& Viewport::ids(const Ui& ui, const ViewArea& area) {
  if (!has_ids_) {
    engine_.read_ids(build_scene(ui, area), static_cast<int>(area.width),
                     static_cast<int>(area.height), ids_);
    has_ids_ = true;
  }
  return ids_;
}

void Viewport::follow_mouse(Ui& ui, const ViewArea& area, bool is_hovered) {
  const ImGuiIO& io = ImGui::GetIO();
  if (drag_ == Drag::None && is_hovered) begin_drag(ui, area);
  if (drag_ != Drag::None) {
    if (ImGui::IsMouseDown(drag_button_)) {
      continue_drag(ui, area);
    } else {
      end_drag(ui, area);
    }
  }
  if (is_hovered && io.MouseWheel != 0) {
    const double x = 2 * (io.MousePos.x - area.x) / area.width - 1;
    const double y = 1 - 2 * (io.MousePos.y - area.y) / area.height;
    ui.state.camera.zoom(io.MouseWheel, x, y, area.aspect());
  }
  last_mouse_ = {io.MousePos.x, io.MousePos.y};
  hover(ui, area, is_hovered);
}

void Viewport::begin_drag(Ui& ui, const ViewArea&) {
  const ImGuiIO& io = ImGui::GetIO();
  for (int button = 0; button < 3; ++button) {
    if (!ImGui::IsMouseClicked(button)) continue;
    drag_button_ = button;
    drag_start_ = last_mouse_ = {io.MousePos.x, io.MousePos.y};
    if (button == 1) {
      drag_ = Drag::Pan;
    } else if (button == 2 || io.KeyAlt) {
      drag_ = Drag::Orbit;
    } else if (ui.state.tool == Tool::Knife) {
      drag_ = Drag::Knife;
    } else {
      drag_ = ui.state.tool == Tool::Box ? Drag::Box : Drag::Pick;
    }
    return;
  }
}

void Viewport::continue_drag(Ui& ui, const ViewArea& area) {
  const ImGuiIO& io = ImGui::GetIO();
  const double dx = io.MousePos.x - last_mouse_[0];
  const double dy = io.MousePos.y - last_mouse_[1];
  const float moved = std::hypot(io.MousePos.x - drag_start_[0], io.MousePos.y - drag_start_[1]);
  if (drag_ == Drag::Orbit) ui.state.camera.orbit(dx, dy);
  if (drag_ == Drag::Pan) ui.state.camera.pan(dx, dy, area.height);
  if (drag_ == Drag::Pick && moved > kDragStart) drag_ = Drag::Box;
  if (drag_ == Drag::Knife && moved > kDragStart) place_knife(ui, area);
}

void Viewport::end_drag(Ui& ui, const ViewArea& area) {
  if (drag_ == Drag::Pick) click(ui);
  if (drag_ == Drag::Box) select_box(ui, area);
  drag_ = Drag::None;
  ui.state.knife.is_dragging = false;
}

void Viewport::hover(Ui& ui, const ViewArea& area, bool is_hovered) {
  if (drag_ != Drag::None) return;
  int label = -1;
  const ImGuiIO& io = ImGui::GetIO();
  // A literal that a list points at recolours the mesh; over the part itself the groups count.
  if (is_hovered) ui.state.hovered_literal = -1;
  const Scene scene = build_scene(ui, area);
  if (is_hovered && ui.session.document().is_ready()) {
    label = ids(ui, area).at(static_cast<int>(io.MousePos.x - area.x),
                             static_cast<int>(io.MousePos.y - area.y));
  }
  const bool groups = picks_groups(scene);
  ui.state.hovered = groups ? label : -1;
  if (!groups && is_hovered) ui.state.hovered_literal = label;
}

void Viewport::click(Ui& ui) {
  if (ui.state.hovered >= 0) {
    select_groups(ui, {ui.state.hovered}, combination());
  } else if (ui.state.hovered_literal >= 0) {
    ui.state.picked_literal = ui.state.hovered_literal;
  } else if (combination() == Combine::Replace) {
    ui.state.selected.clear();
    ui.state.picked_literal = -1;
  }
}

void Viewport::select_box(Ui& ui, const ViewArea& area) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const auto x = [&area](float v) { return static_cast<int>(v - area.x); };
  const auto y = [&area](float v) { return static_cast<int>(v - area.y); };
  const bool must_enclose = mouse.x > drag_start_[0];
  const Scene scene = build_scene(ui, area);
  if (picks_groups(scene)) {
    const auto groups = groups_in(
        ids(ui, area), x(std::min(mouse.x, drag_start_[0])), y(std::min(mouse.y, drag_start_[1])),
        x(std::max(mouse.x, drag_start_[0])), y(std::max(mouse.y, drag_start_[1])), must_enclose);
    select_groups(ui, groups, combination());
  }
  ui.state.tool = Tool::Select;
}

void Viewport::place_knife(Ui& ui, const ViewArea& area) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  ui.state.knife.is_dragging = true;
  ui.state.knife.from = drag_start_;
  ui.state.knife.to = {mouse.x, mouse.y};
  aim_knife(ui, area);
}

void Viewport::draw_rubber_band(const Ui& ui) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ImU32 accent = ImGui::GetColorU32(ui.theme.accent);
  if (drag_ == Drag::Box) {
    ImVec4 fill = ui.theme.accent;
    fill.w = 0.12F;
    list.AddRectFilled({drag_start_[0], drag_start_[1]}, mouse, ImGui::GetColorU32(fill));
    list.AddRect({drag_start_[0], drag_start_[1]}, mouse, accent, 0, 0, 1);
  }
  if (drag_ != Drag::Knife || !ui.state.knife.is_dragging) return;
  const ImVec2 from(ui.state.knife.from[0], ui.state.knife.from[1]);
  list.AddLine(from, mouse, accent, 2 * ui.scale);
  list.AddCircleFilled(from, 4 * ui.scale, accent);
  const std::string count =
      std::to_string(ui.state.knife.crossed) + (ui.state.knife.crossed == 1 ? " group" : " groups");
  const ImVec2 at(mouse.x + 16 * ui.scale, mouse.y + 12 * ui.scale);
  const ImVec2 size = ImGui::CalcTextSize(count.c_str());
  list.AddRectFilled({at.x - 6, at.y - 3}, {at.x + size.x + 6, at.y + size.y + 3},
                     ImGui::GetColorU32(ui.theme.raised), 4);
  list.AddText(at, ImGui::GetColorU32(ui.theme.text), count.c_str());
}

}  // namespace hewn
