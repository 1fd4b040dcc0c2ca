#include "ui/tools/knife_handles.h"

#include <algorithm>
#include <cmath>

#include "ui/tools/knife.h"

namespace hewn {
namespace {

constexpr float kReach_px = 9;
/// Of the part's diagonal: where the handles stand, from the middle of the plane.
constexpr double kArm = 0.3;

using Pixel = std::array<double, 2>;

/// The plane's frame in model coordinates, and where its handles are seen.
struct Frame {
  Vec3 normal, middle, u, w;
  double arm = 1;
  Pixel at_middle{}, at_move{}, at_u{}, at_w{};
};

Pixel to_pixel(const Ui& ui, const ViewArea& area, const Vec3& model) {
  const Vec3 origin = ui.session.document().prepared->mesh->bounds.center();
  const Vec3 seen = ui.state.camera.project(model - origin, area.aspect());
  return {area.x + (seen.x() + 1) / 2 * area.width, area.y + (1 - seen.y()) / 2 * area.height};
}

Frame frame_of(const Ui& ui, const ViewArea& area) {
  const SnappedPlane& plane = *ui.state.knife.plane;
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

bool has_handles(const Ui& ui) {
  return ui.state.tool == Tool::Knife && ui.state.knife.plane && !ui.state.knife.is_dragging &&
         ui.session.document().is_ready();
}

/// How many times the arrow from `from` to `to` the drag goes along it; 0 when it is seen end on.
double share_along(const Pixel& from, const Pixel& to, const std::array<double, 2>& drag) {
  const double x = to[0] - from[0];
  const double y = to[1] - from[1];
  const double length2 = x * x + y * y;
  return length2 < 25 ? 0 : (drag[0] * x + drag[1] * y) / length2;
}

ImVec2 point(const Pixel& p) { return {static_cast<float>(p[0]), static_cast<float>(p[1])}; }

}  // namespace

KnifeHandle knife_handle_at(const Ui& ui, const ViewArea& area, const std::array<float, 2>& pixel) {
  if (!has_handles(ui)) return KnifeHandle::None;
  const Frame f = frame_of(ui, area);
  const auto is_near = [&](const Pixel& p) {
    return std::hypot(p[0] - pixel[0], p[1] - pixel[1]) <= kReach_px * ui.scale;
  };
  if (is_near(f.at_move)) return KnifeHandle::Move;
  if (is_near(f.at_u)) return KnifeHandle::TurnU;
  return is_near(f.at_w) ? KnifeHandle::TurnW : KnifeHandle::None;
}

void drag_knife_handle(Ui& ui, const ViewArea& area, KnifeHandle handle,
                       const std::array<double, 2>& pixels) {
  if (handle == KnifeHandle::None || !has_handles(ui)) return;
  const Frame f = frame_of(ui, area);
  SnappedPlane plane = *ui.state.knife.plane;
  plane.snapped_to.clear();
  const double along = share_along(f.at_middle, f.at_move, pixels) * f.arm / 2;
  if (handle == KnifeHandle::Move) {
    plane.offset += along;
  } else {
    // The end of the arm goes along the normal, the middle stays.
    const Vec3& arm = handle == KnifeHandle::TurnU ? f.u : f.w;
    const double angle_rad = std::atan2(along, f.arm);
    plane.normal = (f.normal * std::cos(angle_rad) - arm * std::sin(angle_rad)).normalized();
    plane.offset = plane.normal.dot(f.middle);
  }
  set_knife_plane(ui, plane);
}

void draw_knife_handles(const Ui& ui, const ViewArea& area) {
  if (!has_handles(ui)) return;
  const Frame f = frame_of(ui, area);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const KnifeHandle hot = knife_handle_at(ui, area, {mouse.x, mouse.y});
  const ImU32 accent = ImGui::GetColorU32(ui.theme.accent);
  const ImU32 fill = ImGui::GetColorU32(ui.theme.raised);
  const auto knob = [&](const Pixel& p, KnifeHandle handle) {
    list.AddLine(point(f.at_middle), point(p), accent, 1.5F * ui.scale);
    const float radius = (handle == hot ? 7.0F : 5.5F) * ui.scale;
    list.AddCircleFilled(point(p), radius, handle == hot ? accent : fill);
    list.AddCircle(point(p), radius, accent, 0, 1.5F * ui.scale);
  };
  knob(f.at_u, KnifeHandle::TurnU);
  knob(f.at_w, KnifeHandle::TurnW);
  knob(f.at_move, KnifeHandle::Move);
  const char* const texts[] = {nullptr, "move along the normal", "turn", "turn"};
  if (hot != KnifeHandle::None) ImGui::SetTooltip("%s", texts[static_cast<int>(hot)]);
}

}  // namespace hewn
