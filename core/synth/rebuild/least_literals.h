#pragma once
/// How many primitives a solid needs at least. Internal to rebuild.
#include <vector>

#include "core/fit/surface_set.h"

namespace hewn {

/// A lower bound on the literals of any tree whose solid has all these halfspaces' surfaces in its
/// boundary: a box, cylinder, cone, prism, sphere or torus has one curved surface at most, and at
/// most two planes across any direction. 0 when there are none.
int least_literals(const std::vector<Halfspace>& halfspaces);

}  // namespace hewn
