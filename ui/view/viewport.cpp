#include "ui/view/viewport.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "ui/actions.h"
#include "ui/tools/knife.h"
#include "ui/tools/marks.h"
#include "ui/tools/measure.h"
#include "ui/view/id_picking.h"
#include "ui/view/unlike_colours.h"
#include "ui/view/warm_up.h"

namespace hewn {
namespace {

constexpr float kDragStart = 4;         // pixels before a press becomes a drag
constexpr double kSlowPicture_ms = 25;  // slower: rough pictures while something changes
constexpr double kBusyPicture_ms = 70;  // slower: details wait until no job runs
constexpr std::chrono::milliseconds kSettle{120};

Combine combination() {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyShift && io.KeyCtrl) return Combine::Remove;
  if (io.KeyShift) return Combine::Add;
  return io.KeyCtrl ? Combine::Toggle : Combine::Replace;
}

/// Framebuffer pixels.
std::array<int, 2> picture_size(const ViewArea& area) {
  const ImVec2 ratio = ImGui::GetIO().DisplayFramebufferScale;
  return {static_cast<int>(std::lround(area.width * ratio.x)),
          static_cast<int>(std::lround(area.height * ratio.y))};
}

bool picks_groups(const Scene& scene) {
  return !scene.items.empty() && scene.items[0].slot == MeshSlot::Input;
}

/// What decides where labels are seen.
Scene geometry_of(const Scene& scene) {
  Scene bare;
  for (const SceneItem& item : scene.items) bare.items.push_back({item.slot});
  bare.origin = scene.origin;
  bare.view = scene.view;
  bare.projection = scene.projection;
  bare.section = scene.section;
  return bare;
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
    has_ids_ = false;
    must_draw_ = true;
    ui.state.hovered = -1;
    ui.state.measure = {};
    ui.state.group_colours = input ? unlike_colours(*input) : std::vector<int>();
    const int count = input ? input->labels : 0;
    std::erase_if(ui.state.selected, [count](int g) { return g >= count; });
    std::erase_if(ui.state.hidden, [count](int g) { return g >= count; });
  }
  const auto result = ui.session.result_view();
  if (result != result_) {
    result_ = result;
    engine_.show_mesh(MeshSlot::Surface, result ? &result->surface : nullptr);
    engine_.show_mesh(MeshSlot::Measured, result ? &result->input : nullptr);
    tree_problem_ = engine_.show_tree(result ? result->program.get() : nullptr);
    ui.state.exact_now = {};
    ui.state.graph.wants_fit = true;
    if (result)
      ui.state.exact_now.problem = result->program ? tree_problem_ : result->program_problem;
    literal_states_.clear();
    has_ids_ = false;
    must_draw_ = true;
    ui.state.hovered_literal = ui.state.hovered_node = ui.state.picked_node = -1;
    const auto shown = ui.session.viewed_result();
    const int literals = shown ? static_cast<int>(shown->found.tree.literals.size()) : 0;
    if (ui.state.picked_literal >= literals) ui.state.picked_literal = -1;
  }
}

void Viewport::sync_states(Ui& ui) {
  auto states = group_states(ui);
  if (states != states_) {
    has_ids_ = has_ids_ && hidden_ == ui.state.hidden;
    hidden_ = ui.state.hidden;
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
  if (std::exchange(is_cold_, false)) {
    const auto [width, height] = picture_size(area);
    warm_up(engine_, width, height);
  }
  sync_meshes(ui);
  if (ui.state.wants_fit && ui.session.document().is_ready()) {
    ui.state.wants_fit = false;
    ui.state.camera.fit(Vec3::Zero(), ui.session.document().prepared->mesh->diagonal() / 2);
  }
  const bool is_hovered = ImGui::IsWindowHovered() && !ImGui::IsAnyItemHovered();
  follow_mouse(ui, area, is_hovered);
  sync_states(ui);
  draw_picture(ui, area);
  draw_plane_handles(ui, area);
  draw_measure(ui, area);
  draw_rubber_band(ui, area);
}

bool Viewport::is_slow() const {
  return engine_.is_software() || detail_cost_ms_ > kSlowPicture_ms;
}

/// Slow engines draw roughly while things change and add what is missing when they stand still.
void Viewport::draw_picture(Ui& ui, const ViewArea& area) {
  Scene scene = build_scene(ui, area);
  const auto now = Clock::now();
  must_draw_ |= !(scene == drawn_) || area.width != drawn_width_ || area.height != drawn_height_;
  if (must_draw_) changed_ = now;
  const bool has_settled = !is_moving() && now - changed_ >= kSettle;
  const bool can_wait = ui.session.is_busy() && detail_cost_ms_ > kBusyPicture_ms;
  is_rough_ = is_slow() && (!has_settled || can_wait);
  const int samples = is_rough_ ? 1 : 4;
  const auto [width, height] = picture_size(area);
  const ExactSituation situation = exact_situation(ui, scene, has_settled);
  const ExactCost& cost = ui.state.exact_now.cost;
  if (needs_trial(ui.state.exact, situation, cost)) try_exact(ui, scene, width, height);
  const bool is_exact = draws_exactly(ui.state.exact, situation, cost);
  ExactSituation rest = exact_situation(ui, scene, true);
  rest.is_rough = false;
  waits_for_exact_ = !is_exact && (draws_exactly(ui.state.exact, rest, cost) ||
                                   needs_trial(ui.state.exact, rest, cost));
  const bool is_same = samples == drawn_samples_ && is_exact == draws_exactly_;
  if (!must_draw_ && (is_same || is_rough_)) return;
  drawn_ = scene;
  draws_exactly_ = is_exact;
  for (SceneItem& item : scene.items) item.is_exact &= is_exact;
  scene.is_coarse = is_rough_;
  const auto start = Clock::now();
  engine_.draw(scene, width, height, samples);
  const std::chrono::duration<double, std::milli> took = Clock::now() - start;
  learn_cost(ui, took.count());
  detail_cost_ms_ = is_rough_ ? std::max(detail_cost_ms_, took.count()) : took.count();
  drawn_samples_ = samples;
  drawn_width_ = area.width;
  drawn_height_ = area.height;
  must_draw_ = false;
}

ExactSituation Viewport::exact_situation(const Ui& ui, const Scene& scene, bool has_settled) const {
  const bool is_wanted = std::any_of(scene.items.begin(), scene.items.end(),
                                     [](const SceneItem& item) { return item.is_exact; });
  ExactSituation situation;
  situation.is_possible = is_wanted && tree_problem_.empty();
  situation.is_hurried = !has_settled || ui.session.is_busy();
  situation.is_rough = is_rough_;
  return situation;
}

/// The second of two small pictures tells what a large one costs; the first makes the driver ready.
void Viewport::try_exact(Ui& ui, const Scene& scene, int width, int height) {
  constexpr int kSmaller = 4;
  Clock::time_point start;
  for (int i = 0; i < 2; ++i) {
    start = Clock::now();
    engine_.draw(scene, std::max(width / kSmaller, 1), std::max(height / kSmaller, 1), 1);
  }
  const std::chrono::duration<double, std::milli> took = Clock::now() - start;
  ui.state.exact_now.cost.rough_ms = took.count() * kSmaller * kSmaller;
  must_draw_ = true;  // over the small one
}

void Viewport::learn_cost(Ui& ui, double took_ms) {
  ExactNow& now = ui.state.exact_now;
  now.is_exact = draws_exactly_;
  if (draws_exactly_) (is_rough_ ? now.cost.rough_ms : now.cost.full_ms) = took_ms;
}

bool Viewport::has_ids(const Scene& scene) const {
  return has_ids_ && ids_scene_ == geometry_of(scene);
}

const IdImage& Viewport::ids(const Scene& scene, const ViewArea& area) {
  if (!has_ids(scene)) {
    Scene seen = scene;
    for (SceneItem& item : seen.items) item.is_exact &= draws_exactly_;
    engine_.read_ids(seen, static_cast<int>(area.width), static_cast<int>(area.height), ids_);
    ids_scene_ = geometry_of(scene);
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

void Viewport::begin_drag(Ui& ui, const ViewArea& area) {
  const ImGuiIO& io = ImGui::GetIO();
  for (int button = 0; button < 3; ++button) {
    if (!ImGui::IsMouseClicked(button)) continue;
    drag_button_ = button;
    drag_start_ = last_mouse_ = {io.MousePos.x, io.MousePos.y};
    if (button == 1) {
      drag_ = Drag::Pan;
    } else if (button == 2 || io.KeyAlt) {
      drag_ = Drag::Orbit;
    } else {
      handle_ = plane_handle_at(ui, area, drag_start_);
      drag_ = handle_ == PlaneHandle::None ? drag_of(ui.state.tool) : Drag::Handle;
    }
    if (drag_ == Drag::Lasso) lasso_ = {drag_start_};
    return;
  }
}

Viewport::Drag Viewport::drag_of(Tool tool) {
  switch (tool) {
    case Tool::Knife:
      return Drag::Knife;
    case Tool::Lasso:
      return Drag::Lasso;
    case Tool::Box:
      return Drag::Box;
    case Tool::Measure:
      return Drag::Measure;
    case Tool::Select:
      break;
  }
  return Drag::Pick;
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
  if (drag_ == Drag::Handle) drag_plane_handle(ui, area, handle_, {dx, dy});
  if (drag_ == Drag::Lasso && std::hypot(io.MousePos.x - lasso_.back()[0],
                                         io.MousePos.y - lasso_.back()[1]) > kDragStart / 2) {
    lasso_.push_back({io.MousePos.x, io.MousePos.y});
  }
}

void Viewport::end_drag(Ui& ui, const ViewArea& area) {
  if (drag_ == Drag::Pick) click(ui, area);
  if (drag_ == Drag::Measure) {
    point_at(ui, area, drag_start_);
    take_spot(ui.state.measure);
  }
  if (drag_ == Drag::Box) select_box(ui, area);
  if (drag_ == Drag::Lasso) select_lasso(ui, area);
  drag_ = Drag::None;
  ui.state.knife.is_dragging = false;
}

void Viewport::hover(Ui& ui, const ViewArea& area, bool is_hovered) {
  waits_for_hover_ = false;
  if (drag_ != Drag::None) return;
  if (!is_hovered) {
    ui.state.hovered = -1;
    ui.state.measure.hovered.reset();
    return;
  }
  ui.state.hovered_literal = ui.state.hovered_node = -1;
  // While a slow picture changes, what is under the mouse can wait; it may rest there by then.
  waits_for_hover_ = is_rough_ && !has_ids(build_scene(ui, area));
  if (waits_for_hover_) return;
  point_at(ui, area, last_mouse_);
}

void Viewport::point_at(Ui& ui, const ViewArea& area, const std::array<float, 2>& mouse) {
  // A literal that a list points at recolours the mesh; over the part itself the groups count.
  ui.state.hovered_literal = ui.state.hovered_node = -1;
  const Scene scene = build_scene(ui, area);
  const int label = ui.session.document().is_ready() ? ids(scene, area)
                                                           .at(static_cast<int>(mouse[0] - area.x),
                                                               static_cast<int>(mouse[1] - area.y))
                                                     : -1;
  const bool groups = picks_groups(scene);
  ui.state.hovered = groups ? label : -1;
  if (!groups) ui.state.hovered_literal = label;
  if (ui.state.tool != Tool::Measure) return;
  const Corner* corner = groups ? corners_.find(ui, area, ids(scene, area), mouse) : nullptr;
  hover_spot(ui, area, mouse, ui.state.hovered, corner);
}

void Viewport::click(Ui& ui, const ViewArea& area) {
  point_at(ui, area, drag_start_);
  if (ui.state.hovered >= 0) {
    select_groups(ui, {ui.state.hovered}, combination());
  } else if (ui.state.hovered_literal >= 0) {
    ui.state.picked_literal = ui.state.hovered_literal;
    ui.state.picked_node = -1;
  } else if (combination() == Combine::Replace) {
    ui.state.selected.clear();
    ui.state.picked_literal = ui.state.picked_node = -1;
  }
}

void Viewport::select_box(Ui& ui, const ViewArea& area) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const auto x = [&area](float v) { return static_cast<int>(v - area.x); };
  const auto y = [&area](float v) { return static_cast<int>(v - area.y); };
  const bool must_enclose = mouse.x > drag_start_[0];
  const Scene scene = build_scene(ui, area);
  if (picks_groups(scene)) {
    const auto groups =
        groups_in(ids(scene, area),
                  {x(std::min(mouse.x, drag_start_[0])), y(std::min(mouse.y, drag_start_[1])),
                   x(std::max(mouse.x, drag_start_[0])), y(std::max(mouse.y, drag_start_[1]))},
                  must_enclose);
    select_groups(ui, groups, combination());
  }
  ui.state.tool = Tool::Select;
}

void Viewport::select_lasso(Ui& ui, const ViewArea& area) {
  const Scene scene = build_scene(ui, area);
  if (picks_groups(scene) && lasso_.size() > 2) {
    for (auto& p : lasso_) p = {p[0] - area.x, p[1] - area.y};
    select_groups(ui, groups_around(ids(scene, area), lasso_), combination());
  }
  lasso_.clear();
  ui.state.tool = Tool::Select;
}

void Viewport::place_knife(Ui& ui, const ViewArea& area) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  ui.state.knife.is_dragging = true;
  ui.state.knife.from = drag_start_;
  ui.state.knife.to = {mouse.x, mouse.y};
  ui.state.knife.from_corner = corner_at(ui, area, ui.state.knife.from);
  ui.state.knife.to_corner = corner_at(ui, area, ui.state.knife.to);
  aim_knife(ui, area);
}

std::optional<Vec3> Viewport::corner_at(Ui& ui, const ViewArea& area,
                                        const std::array<float, 2>& pixel) {
  const Scene scene = build_scene(ui, area);
  if (!picks_groups(scene)) return {};
  const Corner* corner = corners_.find(ui, area, ids(scene, area), pixel);
  return corner ? std::optional(corner->at) : std::nullopt;
}

void Viewport::draw_rubber_band(const Ui& ui, const ViewArea& area) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ImU32 accent = ImGui::GetColorU32(ui.theme.accent);
  if (drag_ == Drag::Box) {
    ImVec4 fill = ui.theme.accent;
    fill.w = 0.12F;
    list.AddRectFilled({drag_start_[0], drag_start_[1]}, mouse, ImGui::GetColorU32(fill));
    list.AddRect({drag_start_[0], drag_start_[1]}, mouse, accent, 0, 0, 1);
  }
  if (drag_ == Drag::Lasso) {
    for (std::size_t i = 0; i + 1 < lasso_.size(); ++i) {
      list.AddLine({lasso_[i][0], lasso_[i][1]}, {lasso_[i + 1][0], lasso_[i + 1][1]}, accent,
                   1.5F * ui.scale);
    }
    list.AddLine({lasso_.back()[0], lasso_.back()[1]}, {lasso_[0][0], lasso_[0][1]},
                 ImGui::GetColorU32(ui.theme.faint));
  }
  if (drag_ != Drag::Knife || !ui.state.knife.is_dragging) return;
  const ImVec2 from(ui.state.knife.from[0], ui.state.knife.from[1]);
  list.AddLine(from, mouse, accent, 2 * ui.scale);
  list.AddCircleFilled(from, 4 * ui.scale, accent);
  const std::string count =
      std::to_string(ui.state.knife.crossed) + (ui.state.knife.crossed == 1 ? " group" : " groups");
  draw_label(ui, mouse, count);
  for (const auto& corner : {ui.state.knife.from_corner, ui.state.knife.to_corner}) {
    if (corner) list.AddCircle(to_pixel(ui, area, *corner), 7 * ui.scale, accent, 0, 2 * ui.scale);
  }
}

}  // namespace hewn
