#include "ui/view/pixels.h"

namespace hewn {

ViewRay ray_at(const Ui& ui, const ViewArea& area, const std::array<float, 2>& pixel) {
  const double x = 2 * (pixel[0] - area.x) / area.width - 1;
  const double y = 1 - 2 * (pixel[1] - area.y) / area.height;
  return ui.state.camera.ray(x, y, area.aspect());
}

ImVec2 to_pixel(const Ui& ui, const ViewArea& area, const Vec3& model) {
  const Vec3 origin = ui.session.document().prepared->mesh->bounds.center();
  const Vec3 seen = ui.state.camera.project(model - origin, area.aspect());
  return {area.x + static_cast<float>(seen.x() + 1) / 2 * area.width,
          area.y + static_cast<float>(1 - seen.y()) / 2 * area.height};
}

}  // namespace hewn
