#include "ui/tools/knife.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace hewn {
namespace {

constexpr double kSnapAngle_rad = 0.09;  // 5 degrees
constexpr double kSnapReach_px = 7;

std::array<float, 2> pixel_of(const Ui& ui, const ViewArea& area, const Vec3& model) {
  const ImVec2 at = to_pixel(ui, area, model);
  return {at.x, at.y};
}

/// Where the ray meets the plane through the target that faces the camera.
Vec3 on_target_plane(const Ui& ui, const ViewRay& ray) {
  const Vec3 back = ui.state.camera.back();
  const double along = (ui.state.camera.target - ray.origin).dot(back) / ray.direction.dot(back);
  return ray.origin + along * ray.direction;
}

}  // namespace

void set_knife_plane(Ui& ui, const SnappedPlane& plane) {
  KnifeState& knife = ui.state.knife;
  const PreparedMesh& prepared = *ui.session.document().prepared;
  std::vector<int> groups = ui.state.selected;
  if (groups.empty()) {
    groups.resize(prepared.segmentation.groups.size());
    std::iota(groups.begin(), groups.end(), 0);
  }
  knife.plane = plane;
  knife.crossed = groups_crossed(prepared, groups, plane.normal, plane.offset);
  std::snprintf(knife.offset_text.data(), knife.offset_text.size(), "%.6g", plane.offset);
}

void aim_knife(Ui& ui, const ViewArea& area) {
  if (!ui.session.document().is_ready()) return;
  const bool is_free = ImGui::GetIO().KeyAlt;
  const KnifeState& knife = ui.state.knife;
  const auto from_corner = is_free ? std::nullopt : knife.from_corner;
  const auto to_corner = is_free ? std::nullopt : knife.to_corner;
  const auto corner = to_corner ? to_corner : from_corner;
  const auto from = from_corner ? pixel_of(ui, area, *from_corner) : knife.from;
  const auto to = to_corner ? pixel_of(ui, area, *to_corner) : knife.to;
  const Vec3 a = on_target_plane(ui, ray_at(ui, area, from));
  const Vec3 b = on_target_plane(ui, ray_at(ui, area, to));
  const std::array<float, 2> middle = {(from[0] + to[0]) / 2, (from[1] + to[1]) / 2};
  const ViewRay ray = ray_at(ui, area, middle);
  const Vec3 through_eye = (b - a).cross(ray.direction);
  if (!(through_eye.norm() > 0)) return;
  const PreparedMesh& prepared = *ui.session.document().prepared;
  const Vec3 through = corner ? *corner : Vec3((a + b) / 2 + prepared.mesh->bounds.center());
  const bool keeps_offset = is_free || corner;
  const double reach =
      keeps_offset ? 0 : kSnapReach_px * ui.state.camera.unit_per_pixel(area.height);
  // What the line means is judged as if it were seen without perspective: a line along an axis
  // stands for a plane along it, off the middle of the picture as well.
  const Vec3 flat = (b - a).cross(-ui.state.camera.back());
  SnappedPlane snapped = snap_plane(prepared, flat, through, is_free ? 0 : kSnapAngle_rad, reach);
  const bool has_direction = angle_between(snapped.normal, flat.normalized()) > 0 ||
                             snapped.snapped_to.find("axis") != std::string::npos;
  if (!has_direction || is_free) snapped = snap_plane(prepared, through_eye, through, 0, reach);
  if (corner) snapped.snapped_to += snapped.snapped_to.empty() ? "corner" : ", corner";
  set_knife_plane(ui, snapped);
}

}  // namespace hewn
