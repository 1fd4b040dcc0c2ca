#include "ui/studio.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/session/describe.h"
#include "ui/actions.h"
#include "ui/panels/widgets.h"

namespace hewn {
namespace {

constexpr int kSpace = 32;
constexpr std::size_t kMostRecent = 8;

bool is_typing() { return ImGui::GetIO().WantTextInput; }

}  // namespace

Studio::Studio(Session& session, RenderEngine& engine, const Fonts& fonts, float scale)
    : ui_{session, state_, dark_theme(), fonts, scale, &actions_}, viewport_(engine) {
  apply_theme(ui_.theme, scale);
}

void Studio::open(const std::filesystem::path& path) { request_open(ui_, path); }

bool Studio::key(int key, int mods, bool is_down) {
  if (key == kSpace && mods == 0 && !is_typing()) {
    state_.is_comparing = is_down;
    return true;
  }
  if (!is_down) return false;
  constexpr int kEscape = 256;
  constexpr int kF1 = 290;
  constexpr int kF25 = 314;
  const bool writes = key != kEscape && (key < kF1 || key > kF25) && !(mods & kCtrl);
  // While a text is typed, letters belong to it; Ctrl, Esc and the keys F1 and on do not.
  if (is_typing() && writes) return false;
  if (is_typing() && (key == 'A' || key == 'Z')) return false;
  return run_shortcut(ui_, key, mods);
}

void Studio::remember_recent() {
  const auto& mesh = ui_.session.document().project.mesh;
  const auto& project = ui_.session.project_path();
  const auto& path = project.empty() ? mesh : project;
  if (path.empty()) return;
  std::error_code ignored;
  const auto full = std::filesystem::absolute(path, ignored);
  auto& recent = state_.recent;
  if (!recent.empty() && recent.front() == full) return;
  std::erase(recent, full);
  recent.insert(recent.begin(), full);
  if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

void Studio::draw_splitter(const char* name, float x, const PanelArea& middle, float& width,
                           float sign) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  begin_panel(name, {x, middle.y, ui_.px(4), middle.height});
  ImGui::InvisibleButton("drag", {ui_.px(4), middle.height});
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  }
  if (ImGui::IsItemActive()) {
    width = std::clamp(width + sign * ImGui::GetIO().MouseDelta.x / ui_.scale, 200.0F, 520.0F);
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

void Studio::draw_view(const PanelArea& area) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  begin_panel("view", area, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  viewport_.draw(ui_, {area.x, area.y, area.width, area.height});
  draw_gizmo(ui_, area);
  if (ui_.session.document().project.mesh.empty()) {
    const char* text = "Drop a mesh here, or press Ctrl+O";
    const ImVec2 size = ImGui::CalcTextSize(text);
    ImGui::SetCursorScreenPos(
        {area.x + (area.width - size.x) / 2, area.y + (area.height - size.y) / 2});
    faint_text(ui_, text);
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

void Studio::set_backing(const PanelArea& view, std::initializer_list<PanelArea> panels,
                         std::initializer_list<PanelArea> splitters) {
  const ImVec2 ratio = ImGui::GetIO().DisplayFramebufferScale;
  const auto vec = [](const ImVec4& c) { return glm::vec4(c.x, c.y, c.z, 1); };
  const auto pixels = [](float v, float by) { return static_cast<int>(std::lround(v * by)); };
  const auto add = [&](const PanelArea& area, const ImVec4& colour) {
    backing_.fills.push_back({pixels(area.x, ratio.x), pixels(area.y, ratio.y),
                              pixels(area.width, ratio.x), pixels(area.height, ratio.y),
                              vec(colour)});
  };
  backing_.lines = vec(ui_.theme.line);
  backing_.fills.clear();
  for (const PanelArea& panel : panels) add(panel, ui_.theme.panel);
  for (const PanelArea& splitter : splitters) add(splitter, ui_.theme.background);
  backing_.picture_x = pixels(view.x, ratio.x);
  backing_.picture_y = pixels(view.y, ratio.y);
}

/// What floats over the part, the later over the earlier.
void Studio::draw_cards(const PanelArea& view, const PanelArea& window) {
  draw_selection_card(ui_, view);
  draw_knife_card(ui_, view);
  draw_measure_card(ui_, view);
  draw_section_card(ui_, view);
  draw_deviation_legend(ui_, view);
  draw_exact_card(ui_, view);
  draw_hints(ui_, view);
  draw_recovery(ui_, view);
  draw_settings(ui_, view);
  draw_log(ui_, view);
  draw_leave_card(ui_, view);
  draw_notices(ui_, view);
  draw_palette(ui_, window);
  draw_keys(ui_, window);
  draw_file_panel(ui_, window);
}

void Studio::frame(float width, float height) {
  if (state_.is_light != was_light_) {
    was_light_ = state_.is_light;
    ui_.theme = state_.is_light ? light_theme() : dark_theme();
    apply_theme(ui_.theme, ui_.scale);
  }
  remember_recent();
  state_.begin_frame();
  ImGui::PushFont(ui_.fonts.body);
  ImGui::PushStyleColor(ImGuiCol_MenuBarBg, ui_.theme.panel);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui_.px(8), ui_.px(6)});
  float top = 0;
  if (ImGui::BeginMainMenuBar()) {
    draw_menu_bar(ui_);
    top = ImGui::GetWindowHeight();
    ImGui::EndMainMenuBar();
  }
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();

  const float left = state_.shows_plan ? ui_.px(state_.left_width) : 0;
  const float right = state_.shows_result ? ui_.px(state_.right_width) : 0;
  const float bottom = ui_.px(26);
  const float split = ui_.px(4);
  const float tools = ui_.px(40);
  const float inner = height - top - bottom - 1;
  const PanelArea window{0, top, width, inner};
  const PanelArea middle{left + split, top + 1, width - left - right - 2 * split, inner};
  const PanelArea view{middle.x, middle.y + tools, middle.width, middle.height - tools};
  const PanelArea plan{0, top + 1, left, inner};
  const PanelArea toolbar{middle.x, middle.y, middle.width, tools};
  const PanelArea result{width - right, top + 1, right, inner};
  const PanelArea status{0, height - bottom, width, bottom};
  set_backing(view, {plan, toolbar, result, status},
              {{left, middle.y, split, inner}, {width - right - split, middle.y, split, inner}});
  if (state_.shows_plan) {
    draw_plan_panel(ui_, plan);
    draw_splitter("left edge", left, middle, state_.left_width, 1);
  }
  draw_toolbar(ui_, toolbar);
  draw_view(view);
  if (state_.shows_result) {
    draw_splitter("right edge", width - right - split, middle, state_.right_width, -1);
    draw_result_panel(ui_, result);
  }
  ui_.session.preview(state_.hovered_result);
  draw_status_bar(ui_, status);
  draw_cards(view, window);
  ImGui::PopFont();
}

std::string Studio::status_line() const {
  const Session& session = ui_.session;
  const Document& document = session.document();
  const auto shown = session.shown_result();
  nlohmann::json out = {
      {"ready", document.is_ready()},
      {"busy", session.is_busy()},
      {"selected", state_.selected.size()},
      {"hovered", state_.hovered},
      {"undo", session.history().depth()},
      {"can_redo", session.history().can_redo()},
      {"cuts", document.project.cuts.size()},
      {"partitions", document.project.root.children.size()},
      {"results", session.results().size()},
      {"is_current", session.current_result() != nullptr},
      {"is_draft", session.shows_draft()},
      {"has_view", session.result_view() != nullptr},
      {"has_plane", state_.knife.plane.has_value()},
      {"has_file_panel", state_.file.kind != FileRequest::Kind::None},
      {"file_name", state_.file.name},
      {"is_asking", state_.leaving.has_value()},
      {"is_previewing", session.is_previewing()},
      {"measured", state_.measure.spots.size()},
      {"hovered_literal", state_.hovered_literal},
      {"hovered_result", state_.hovered_result ? state_.hovered_result->source : ""},
      {"active_field", state_.active_field},
      {"is_exact", state_.exact_now.is_exact},
      {"shows_graph", state_.shows_graph},
      {"recoverable", state_.recoverable.size()},
      {"is_rough", viewport_.wants_detail()}};
  if (document.is_ready()) {
    const auto& groups = document.prepared->segmentation.groups;
    const auto hovered = static_cast<std::size_t>(state_.hovered);
    out["groups"] = groups.size();
    out["hovered_text"] = hovered < groups.size() ? describe_group(groups[hovered]) : "";
  }
  if (shown) {
    const Tree& tree = shown->found.tree;
    out["literals"] = literal_count(tree);
    const auto picked = static_cast<std::size_t>(state_.picked_literal);
    if (picked < tree.literals.size()) out["picked"] = describe_literal(tree.literals[picked]);
  }
  std::vector<std::string> notices;
  for (const Notice& notice : session.notices()) notices.push_back(notice.text);
  out["notices"] = notices;
  return out.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void Studio::load_settings(const std::filesystem::path& file) {
  const auto text = read_file(file);
  if (!text) return;
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object()) return;
  try {
    state_.is_light = json.value("light", false);
    state_.exact = static_cast<ExactMode>(std::clamp(json.value("exact", 0), 0, 2));
    state_.left_width = std::clamp(json.value("left", state_.left_width), 200.0F, 520.0F);
    state_.right_width = std::clamp(json.value("right", state_.right_width), 200.0F, 520.0F);
    state_.shows_plan = json.value("plan", true);
    state_.shows_result = json.value("result", true);
    state_.window_width = std::clamp(json.value("width", 0), 0, 16384);
    state_.window_height = std::clamp(json.value("height", 0), 0, 16384);
    state_.shows_hints = json.value("hints", true);
    for (const auto& path : json.value("recent", std::vector<std::string>{})) {
      if (state_.recent.size() < kMostRecent) state_.recent.emplace_back(path);
    }
  } catch (const nlohmann::json::exception&) {
    return;  // settings of another version: what was read stays
  }
}

Result<void> Studio::save_settings(const std::filesystem::path& file) const {
  std::vector<std::string> recent;
  for (const auto& path : state_.recent) recent.push_back(path.string());
  const nlohmann::json json = {
      {"light", state_.is_light},     {"exact", static_cast<int>(state_.exact)},
      {"left", state_.left_width},    {"right", state_.right_width},
      {"plan", state_.shows_plan},    {"result", state_.shows_result},
      {"width", state_.window_width}, {"height", state_.window_height},
      {"hints", state_.shows_hints},  {"recent", recent}};
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  return write_file(file,
                    json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace hewn
