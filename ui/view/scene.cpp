#include "ui/view/scene.h"

namespace hewn {

int IdImage::at(int x, int y) const {
  if (x < 0 || y < 0 || x >= width || y >= height) return -1;
  return static_cast<int>(ids[static_cast<std::size_t>(height - 1 - y) * width + x]) - 1;
}

void NullEngine::read_ids(const Scene&, int width, int height, IdImage& out) {
  out.width = width;
  out.height = height;
  out.ids.assign(static_cast<std::size_t>(width) * height, 0);
}

}  // namespace hewn
