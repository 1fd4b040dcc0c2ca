#include "ui/view/look.h"

#include <algorithm>
#include <set>

#include "core/csg/tree_nodes.h"

namespace hewn {
namespace {

glm::vec3 rgb(const ImVec4& c) { return {c.x, c.y, c.z}; }

bool holds(const std::vector<int>& sorted, int value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

/// Of each group the colour of the partition that owns it; grey without one.
std::vector<LabelState> colours_of_owners(const Ui& ui) {
  std::vector<LabelState> out(ui.session.document().prepared->segmentation.groups.size(),
                              {0x9a, 0xa0, 0xa6, 0});
  const auto& views = ui.session.partitions();
  for (std::size_t p = 0; p < views.size(); ++p) {
    for (const int g : views[p].partition.groups) out[g] = partition_colour(views[p], p);
  }
  return out;
}

LabelState base_state(const Ui& ui, int group, const std::vector<LabelState>& owner) {
  const FaceGroup& face = ui.session.document().prepared->segmentation.groups[group];
  switch (ui.state.colours) {
    case ColourMode::Kind:
      return kind_state(face.surface.kind, face.is_fitted);
    case ColourMode::Partition:
      return owner[group];
    case ColourMode::Group:
    case ColourMode::Deviation:
      break;
  }
  return group_colour(ui, group);
}

/// The literal, and those below the operation; -1: none.
std::set<int> marked(const Tree& tree, int literal, int node) {
  std::set<int> out;
  if (literal >= 0) out.insert(literal);
  if (node < 0 || static_cast<std::size_t>(node) >= tree.nodes.size()) return out;
  const auto below = literals_below(tree, node);
  out.insert(below.begin(), below.end());
  return out;
}

/// A square in the plane, as large as the part.
SceneSheet sheet_for(const Vec3& normal, double offset, const Box3& bounds, const Vec3& origin) {
  SceneSheet sheet;
  const Vec3 center = bounds.center() + normal * (offset - normal.dot(bounds.center())) - origin;
  const Tangents frame = tangents(normal);
  const double reach = 0.58 * bounds.diagonal();
  const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int k = 0; k < 4; ++k) {
    const Vec3 p = center + frame.u * (signs[k][0] * reach) + frame.w * (signs[k][1] * reach);
    sheet.corners[k] = {static_cast<float>(p.x()), static_cast<float>(p.y()),
                        static_cast<float>(p.z())};
  }
  return sheet;
}

glm::vec4 scene_plane(const Vec3& normal, double offset, const Vec3& origin) {
  const double shifted = offset - normal.dot(origin);
  return {static_cast<float>(normal.x()), static_cast<float>(normal.y()),
          static_cast<float>(normal.z()), static_cast<float>(shifted)};
}

void add_items(const Ui& ui, Scene& scene) {
  const ShowMode show = shown_mode(ui);
  const auto view = ui.session.result_view();
  const bool has_surface = view && !view->surface.corners.empty();
  SceneItem input;
  input.opacity = ui.state.is_xray ? 0.35F : 1;
  if (shows_deviation(ui)) {
    input.slot = MeshSlot::Measured;
    input.shows_deviation = true;
    input.fades_exact = show == ShowMode::Difference;
    input.deviation_scale = deviation_scale(ui);
    scene.items.push_back(input);
    return;
  }
  if (show == ShowMode::Input || show == ShowMode::Difference || !has_surface) {
    // What a literal in the tree explains of the mesh.
    if (view && (ui.state.hovered_literal >= 0 || ui.state.hovered_node >= 0))
      input.slot = MeshSlot::Measured;
    scene.items.push_back(input);
    return;
  }
  SceneItem surface;
  surface.slot = MeshSlot::Surface;
  surface.opacity = input.opacity;
  surface.is_exact = view->program && ui.state.exact != ExactMode::Off && !ui.state.is_wireframe;
  scene.items.push_back(surface);
  if (show == ShowMode::Overlay) {
    input.opacity = 0.22F;
    scene.items.push_back(input);
  }
}

void set_colours(const Ui& ui, Scene& scene) {
  const Theme& theme = ui.theme;
  const glm::vec3 base = rgb(theme.background);
  scene.top = theme.is_light ? glm::vec3(0.985F) : base * 1.35F;
  scene.bottom = theme.is_light ? base * 0.93F : base * 0.85F;
  scene.accent = to_linear(theme.accent);
  scene.cut_face = theme.is_light ? glm::vec3(0.20F, 0.22F, 0.25F) : glm::vec3(0.10F, 0.11F, 0.13F);
  scene.line =
      theme.is_light ? glm::vec4(0.11F, 0.13F, 0.16F, 0.85F) : glm::vec4(0.04F, 0.05F, 0.06F, 0.9F);
  scene.selected_line = glm::vec4(rgb(theme.accent), 1);
  scene.line_width = std::max(1.0F, ui.px(1) * ImGui::GetIO().DisplayFramebufferScale.x);
}

}  // namespace

LabelState group_colour(const Ui& ui, int group) {
  const auto g = static_cast<std::size_t>(group);
  return golden_state(g < ui.state.group_colours.size() ? ui.state.group_colours[g] : group);
}

LabelState partition_colour(const PartitionView& partition, std::size_t place) {
  if (!partition.colour) return golden_state(static_cast<int>(place));
  const std::uint32_t c = *partition.colour;
  return {static_cast<std::uint8_t>(c >> 16), static_cast<std::uint8_t>(c >> 8),
          static_cast<std::uint8_t>(c), 0};
}

ShowMode shown_mode(const Ui& ui) {
  if (ui.state.is_comparing) return ShowMode::Input;
  const bool hides_result = ui.state.show == ShowMode::Input;
  return hides_result && ui.session.is_previewing() ? ShowMode::Result : ui.state.show;
}

bool shows_deviation(const Ui& ui) {
  const ShowMode show = shown_mode(ui);
  if (!ui.session.result_view()) return false;
  if (show == ShowMode::Difference) return true;
  return ui.state.colours == ColourMode::Deviation && show == ShowMode::Input;
}

glm::vec2 deviation_scale(const Ui& ui) {
  const auto view = ui.session.result_view();
  const double diagonal = ui.session.document().prepared->mesh->diagonal();
  const double tolerance = ui.state.tolerance_share * diagonal;
  const double largest = std::max(view ? view->max_deviation : 0, 2 * tolerance);
  return {static_cast<float>(tolerance), static_cast<float>(largest)};
}

std::vector<LabelState> group_states(const Ui& ui) {
  const Document& document = ui.session.document();
  std::vector<LabelState> states;
  if (!document.is_ready()) return states;
  std::vector<LabelState> owner;
  if (ui.state.colours == ColourMode::Partition) owner = colours_of_owners(ui);
  const int count = static_cast<int>(document.prepared->segmentation.groups.size());
  const bool has_knife = ui.state.knife.plane.has_value();
  for (int g = 0; g < count; ++g) {
    LabelState state = base_state(ui, g, owner);
    if (ui.state.hidden.contains(g)) state.flags |= kHiddenFlag;
    if (holds(ui.state.selected, g)) state.flags |= kSelectedFlag;
    if (g == ui.state.hovered || holds(ui.state.hovered_groups, g)) state.flags |= kHoveredFlag;
    const bool is_cut = ui.state.selected.empty() || holds(ui.state.selected, g);
    if (has_knife && is_cut) {
      state.flags |= kUnderKnifeFlag;
      state.flags &= static_cast<std::uint8_t>(~kSelectedFlag);
    }
    states.push_back(state);
  }
  return states;
}

std::vector<LabelState> literal_states(const Ui& ui) {
  const auto shown = ui.session.viewed_result();
  std::vector<LabelState> states;
  if (!shown) return states;
  const int count = static_cast<int>(shown->found.tree.literals.size());
  const auto picked = marked(shown->found.tree, ui.state.picked_literal, ui.state.picked_node);
  const auto hovered = marked(shown->found.tree, ui.state.hovered_literal, ui.state.hovered_node);
  const bool has_pick = !picked.empty() || !hovered.empty();
  for (int l = 0; l < count; ++l) {
    LabelState state = golden_state(l);
    if (picked.contains(l)) state.flags |= kSelectedFlag;
    if (hovered.contains(l)) state.flags |= kHoveredFlag;
    if (has_pick && state.flags == 0) state.flags |= kFadedFlag;
    states.push_back(state);
  }
  return states;
}

Scene build_scene(const Ui& ui, const ViewArea& area) {
  Scene scene;
  set_colours(ui, scene);
  scene.view = ui.state.camera.view();
  scene.projection = ui.state.camera.projection(area.aspect());
  scene.is_wireframe = ui.state.is_wireframe;
  scene.hides_faces = !ui.state.hidden.empty();
  const Document& document = ui.session.document();
  if (!document.is_ready()) return scene;
  const Box3& bounds = document.prepared->mesh->bounds;
  scene.origin = bounds.center();
  add_items(ui, scene);
  if (const auto& section = ui.state.section) {
    scene.section = scene_plane(section->normal, section->offset, scene.origin);
  }
  if (const auto& plane = ui.state.knife.plane) {
    scene.has_knife = true;
    scene.knife = scene_plane(plane->normal, plane->offset, scene.origin);
    scene.sheets.push_back(sheet_for(plane->normal, plane->offset, bounds, scene.origin));
    scene.sheets.back().tint = glm::vec4(rgb(ui.theme.accent), 0.16F);
  }
  return scene;
}

}  // namespace hewn
