#include "core/synth/inside_diagonal.h"

#include <cmath>
#include <vector>

#include "core/csg/tree_ray.h"

namespace hewn {

double diagonal_of_inside(const Tree& tree, const Arrangement& arrangement, const Column& inside) {
  constexpr std::size_t kMostPoints = 500;
  std::vector<Vec3> points;
  for_each_bit(inside, [&](std::size_t c) {
    if (c < arrangement.size()) points.push_back(arrangement.points[c]);
  });
  const TreeRays rays(tree);
  TreeRayScratch scratch;
  Box3 box;
  const double reach = 4 * arrangement.scale;
  const std::size_t step = 1 + points.size() / kMostPoints;
  for (std::size_t i = 0; i < points.size(); i += step) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 from = points[i] - reach * Vec3::Unit(k);
      for (const TreeInterval& s : rays.cast(from, Vec3::Unit(k), scratch)) {
        if (!std::isfinite(s.enter.t) || !std::isfinite(s.leave.t)) continue;
        box.extend(from + s.enter.t * Vec3::Unit(k));
        box.extend(from + s.leave.t * Vec3::Unit(k));
      }
    }
  }
  return box.diagonal();
}

}  // namespace hewn
