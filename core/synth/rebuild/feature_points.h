#pragma once
/// Points of one and the same feature of a solid.
#include <vector>

#include "core/base/rng.h"
#include "core/csg/tree_ray.h"

namespace hewn {

/// Points midway through the wall or the gap that holds `p`, up to `count` of them, near and far
/// beside it: where one point of a wall matters, others do. All are as `p` inside or outside the
/// tree's solid. `scale`: its diagonal. Cost: a ray each.
std::vector<Vec3> points_beside(const TreeRays& rays, const Vec3& p, int count, double scale,
                                Rng& rng);

}  // namespace hewn
