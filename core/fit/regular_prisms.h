#pragma once
/// Plane sides that together bound a regular prism: nuts, sockets, bars.
#include <vector>

#include "core/fit/halfspace_side.h"
#include "core/fit/surface_set.h"

namespace hewn {

/// A regular prism without ends. A term that contains all its sides needs one primitive for them.
struct RegularPrism {
  std::vector<HalfspaceSide> sides;  ///< in order around the axis
  Vec3 axis;                         ///< unit
  Vec3 center;                       ///< a point on the axis
  Vec3 normal;                       ///< unit, outward, of the first side
  double radius = 0;                 ///< of the inscribed circle

  int count() const { return static_cast<int>(sides.size()); }
  /// Unit, outward, of side `k` of the ideal prism.
  Vec3 side_normal(int k) const;
};

/// All regular prisms of 5 to 14 sides among the planes, those of more sides first. Four sides are
/// a box; any three planes at the right angles make a triangle, which is seldom meant and often
/// flush with its neighbours. Every side is as near to the ideal one as its halfspace's tolerance
/// or 1e-4 of the inscribed radius. Cost: cubic in the parallel planes of a direction, for
/// directions that meet at a regular polygon's angle; bounded.
std::vector<RegularPrism> find_regular_prisms(const SurfaceSet& surfaces);

/// Moves the sides of regular prisms onto the ideal ones, with a round radius and centre where the
/// sides' own deviations allow it, so that what else is bounded by a side is flush with the prism.
/// Returns the halfspaces that moved, ascending; none moves further than `find_regular_prisms`
/// forgives, nor where all sides are flush as they are.
std::vector<int> settle_regular_prisms(SurfaceSet& surfaces, double diagonal, bool round_values);

}  // namespace hewn
