#include "ui/tools/corner_finder.h"

#include <algorithm>
#include <cmath>

namespace hewn {
namespace {

constexpr float kReach_px = 8;

bool is_seen(const Corner& corner, const IdImage& ids, int x, int y) {
  constexpr int kBeside_px = 2;
  for (int dy = -kBeside_px; dy <= kBeside_px; ++dy) {
    for (int dx = -kBeside_px; dx <= kBeside_px; ++dx) {
      const int label = ids.at(x + dx, y + dy);
      if (std::binary_search(corner.groups.begin(), corner.groups.end(), label)) return true;
    }
  }
  return false;
}

}  // namespace

const Corner* CornerFinder::find(const Ui& ui, const ViewArea& area, const IdImage& ids,
                                 const std::array<float, 2>& pixel) {
  const auto& prepared = ui.session.document().prepared;
  if (!prepared) return nullptr;
  if (corners_of_ != prepared) {
    corners_of_ = prepared;
    corners_ = corners_of(*prepared);
  }
  const Corner* best = nullptr;
  float nearest = kReach_px * ui.scale;
  for (const Corner& corner : corners_) {
    const ImVec2 at = to_pixel(ui, area, corner.at);
    const float apart = std::hypot(at.x - pixel[0], at.y - pixel[1]);
    if (apart >= nearest) continue;
    const auto& section = ui.state.section;
    if (section && section->normal.dot(corner.at) > section->offset) continue;
    if (!is_seen(corner, ids, static_cast<int>(at.x - area.x), static_cast<int>(at.y - area.y))) {
      continue;
    }
    nearest = apart;
    best = &corner;
  }
  return best;
}

}  // namespace hewn
