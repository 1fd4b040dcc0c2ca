#include "core/synth/rebuild/least_literals.h"

#include <algorithm>
#include <map>

namespace hewn {
namespace {

/// What bounds the solid across one direction.
struct Across {
  int planes = 0;
  int tubes = 0;  ///< cylinders and cones along it, each with two ends to give
};

}  // namespace

int least_literals(const std::vector<Halfspace>& halfspaces) {
  std::map<int, Across> by_direction;
  int curved = 0;
  for (const Halfspace& h : halfspaces) {
    const SurfaceKind kind = h.surface.kind;
    if (kind == SurfaceKind::Plane) {
      ++by_direction[h.direction].planes;
      continue;
    }
    ++curved;
    const bool is_tube = kind == SurfaceKind::Cylinder || kind == SurfaceKind::Cone;
    if (is_tube) ++by_direction[h.direction].tubes;
  }
  int most_flat = 0;  // literals needed for planes alone
  for (const auto& [direction, across] : by_direction) {
    most_flat = std::max(most_flat, (across.planes - 2 * across.tubes + 1) / 2);
  }
  return curved + most_flat;
}

}  // namespace hewn
