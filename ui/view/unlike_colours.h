#pragma once
/// Colours by number in which no face looks like the one beside it.
#include <vector>

#include "core/session/display_mesh.h"

namespace hewn {

/// For each label of the mesh a number for `golden_state`: its own where that will do, else one of
/// the next whose hue is at least 40 degrees from those of all faces beside it with lower labels,
/// or the best there is. Cost: O(n log n) for n lines.
std::vector<int> unlike_colours(const DisplayMesh& mesh);

}  // namespace hewn
