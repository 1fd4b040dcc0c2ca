#include "ui/tools/section.h"

#include <cmath>

namespace hewn {

void next_section(Ui& ui) {
  const int k = ui.state.section ? axis_across(ui.state.section->normal) + 1 : 0;
  if (k == 3) {
    ui.state.section.reset();
  } else {
    const Box3& bounds = ui.session.document().prepared->mesh->bounds;
    ui.state.section = ViewPlane{Vec3::Unit(k), bounds.center()[k]};
  }
}

void flip_section(ViewPlane& section) {
  section.normal = -section.normal;
  section.offset = -section.offset;
}

int axis_across(const Vec3& normal) {
  for (int k = 0; k < 3; ++k) {
    if (std::abs(normal[k]) > 1 - 1e-12) return k;
  }
  return -1;
}

std::pair<double, double> extent_along(const Ui& ui, const Vec3& normal) {
  const Box3& bounds = ui.session.document().prepared->mesh->bounds;
  const double middle = normal.dot(bounds.center());
  const double reach = normal.cwiseAbs().dot(bounds.size()) / 2;
  return {middle - reach, middle + reach};
}

}  // namespace hewn
