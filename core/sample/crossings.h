#pragma once
/// Where flat faces of two literals cross. Internal to core/sample.
#include <cstddef>
#include <vector>

#include "core/base/rng.h"
#include "core/sample/arrangement.h"

namespace hewn {

/// The common line of two planes of different literals.
struct Crossing {
  Vec3 normal_p, normal_q;    ///< unit
  double offset_p, offset_q;  ///< of the planes along them
  Vec3 along;                 ///< its square is that of the sine between the planes

  /// A point at these distances from the planes, along their normals.
  Vec3 point(double beyond_p, double beyond_q) const;
};

struct Crossings {
  std::vector<Crossing> found;
  bool are_all = false;  ///< else some of too many
};

/// Crossings that meet the bounds of both literals, the later of which is in [`first`, `end`). All
/// of them, or `most` random ones when they are more. Cost: O(literals^2 + result).
Crossings find_crossings(const Arrangement& arrangement, std::size_t first, std::size_t end,
                         std::size_t most, Rng rng);

}  // namespace hewn
