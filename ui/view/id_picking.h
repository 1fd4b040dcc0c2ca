#pragma once
/// Face groups in a part of the picture.
#include <array>
#include <vector>

#include "ui/view/scene.h"

namespace hewn {

/// A rectangle of pixels from the picture's top left, its ends included.
struct PixelBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Groups with pixels in the box, ascending; `must_enclose`: and none outside.
std::vector<int> groups_in(const IdImage& ids, const PixelBox& box, bool must_enclose);

/// Groups with more of their pixels inside the closed line than outside, ascending.
std::vector<int> groups_around(const IdImage& ids, const std::vector<std::array<float, 2>>& line);

}  // namespace hewn
