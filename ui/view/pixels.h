#pragma once
/// Between the window's pixels and the part.
#include <array>

#include "ui/studio_state.h"

namespace hewn {

/// Where a view is.
struct ViewArea {
  float x = 0, y = 0;           ///< window pixels, top left
  float width = 1, height = 1;  ///< pixels
  double aspect() const { return width / height; }
};

/// What lies under a window pixel, in scene coordinates.
ViewRay ray_at(const Ui& ui, const ViewArea& area, const std::array<float, 2>& pixel);

/// The window pixel where a point of the model appears. Requires: the document is ready.
ImVec2 to_pixel(const Ui& ui, const ViewArea& area, const Vec3& model);

}  // namespace hewn
