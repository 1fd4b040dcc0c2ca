#include "ui/tools/plane_handles.h"

#include <algorithm>
#include <cmath>

#include "ui/tools/knife.h"

namespace hewn {
namespace {

constexpr float kReach_px = 9;
/// Of the part's diagonal: where the handles stand, from the middle of the plane.
constexpr double kArm = 0.3;

/// The plane's frame in model coordinates, and where its handles are seen.
struct Frame {
  Vec3 normal, middle, u, w;
  double arm = 1;
  ImVec2 at_middle, at_move, at_u, at_w;
};

Frame frame_of(const Ui& ui, const ViewArea& area, const ViewPlane& plane) {
  const Box3& bounds = ui.session.document().prepared->mesh->bounds;
  Frame f;
  f.normal = plane.normal;
  f.middle = bounds.center() + plane.normal * (plane.offset - plane.normal.dot(bounds.center()));
  const Tangents frame = tangents(plane.normal);
  f.u = frame.u;
  f.w = frame.w;
  f.arm = kArm * bounds.diagonal();
  f.at_middle = to_pixel(ui, area, f.middle);
  f.at_move = to_pixel(ui, area, f.middle + f.normal * (f.arm / 2));
  f.at_u = to_pixel(ui, area, f.middle + f.u * f.arm);
  f.at_w = to_pixel(ui, area, f.middle + f.w * f.arm);
  return f;
}

/// The plane that has handles now.
std::optional<ViewPlane> handled_plane(const Ui& ui) {
  if (!ui.session.document().is_ready()) return {};
  if (ui.state.tool != Tool::Knife) return ui.state.section;
  const KnifeState& knife = ui.state.knife;
  if (!knife.plane || knife.is_dragging) return {};
  return ViewPlane{knife.plane->normal, knife.plane->offset};
}

void set_handled_plane(Ui& ui, const ViewPlane& plane) {
  if (ui.state.tool == Tool::Knife) {
    set_knife_plane(ui, {plane.normal, plane.offset, ""});
  } else {
    ui.state.section = plane;
  }
}

/// How many times the arrow from `from` to `to` the drag goes along it; 0 when it is seen end on.
double share_along(const ImVec2& from, const ImVec2& to, const std::array<double, 2>& drag) {
  const double x = to.x - from.x;
  const double y = to.y - from.y;
  const double length2 = x * x + y * y;
  return length2 < 25 ? 0 : (drag[0] * x + drag[1] * y) / length2;
}

}  // namespace

PlaneHandle plane_handle_at(const Ui& ui, const ViewArea& area, const std::array<float, 2>& pixel) {
  const auto plane = handled_plane(ui);
  if (!plane) return PlaneHandle::None;
  const Frame f = frame_of(ui, area, *plane);
  const auto is_near = [&](const ImVec2& p) {
    return std::hypot(p.x - pixel[0], p.y - pixel[1]) <= kReach_px * ui.scale;
  };
  if (is_near(f.at_move)) return PlaneHandle::Move;
  if (is_near(f.at_u)) return PlaneHandle::TurnU;
  return is_near(f.at_w) ? PlaneHandle::TurnW : PlaneHandle::None;
}

void drag_plane_handle(Ui& ui, const ViewArea& area, PlaneHandle handle,
                       const std::array<double, 2>& pixels) {
  auto plane = handled_plane(ui);
  if (handle == PlaneHandle::None || !plane) return;
  const Frame f = frame_of(ui, area, *plane);
  const double along = share_along(f.at_middle, f.at_move, pixels) * f.arm / 2;
  if (handle == PlaneHandle::Move) {
    plane->offset += along;
  } else {
    // The end of the arm goes along the normal, the middle stays.
    const Vec3& arm = handle == PlaneHandle::TurnU ? f.u : f.w;
    const double angle_rad = std::atan2(along, f.arm);
    plane->normal = (f.normal * std::cos(angle_rad) - arm * std::sin(angle_rad)).normalized();
    plane->offset = plane->normal.dot(f.middle);
  }
  set_handled_plane(ui, *plane);
}

void draw_plane_handles(const Ui& ui, const ViewArea& area) {
  const auto plane = handled_plane(ui);
  if (!plane) return;
  const Frame f = frame_of(ui, area, *plane);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const PlaneHandle hot = plane_handle_at(ui, area, {mouse.x, mouse.y});
  const ImU32 accent = ImGui::GetColorU32(ui.theme.accent);
  const ImU32 fill = ImGui::GetColorU32(ui.theme.raised);
  const auto knob = [&](const ImVec2& p, PlaneHandle handle) {
    list.AddLine(f.at_middle, p, accent, 1.5F * ui.scale);
    const float radius = (handle == hot ? 7.0F : 5.5F) * ui.scale;
    list.AddCircleFilled(p, radius, handle == hot ? accent : fill);
    list.AddCircle(p, radius, accent, 0, 1.5F * ui.scale);
  };
  knob(f.at_u, PlaneHandle::TurnU);
  knob(f.at_w, PlaneHandle::TurnW);
  knob(f.at_move, PlaneHandle::Move);
  const char* const texts[] = {nullptr, "move along the normal", "turn", "turn"};
  if (hot != PlaneHandle::None) ImGui::SetTooltip("%s", texts[static_cast<int>(hot)]);
}

}  // namespace hewn
