#pragma once
/// The values of a face group that follow from its triangles and its surface.
#include <vector>

#include "core/fit/face_groups.h"
#include "core/mesh/mesh.h"

namespace hewn {

/// Sets area, side, largest and root mean square deviation from `triangles` and `surface`.
/// Cost: O(n log n) in the group's triangles.
void measure_group(const Mesh& mesh, FaceGroup& group);

/// The vertices of some triangles, ascending, each once.
std::vector<int> vertices_of(const Mesh& mesh, const std::vector<int>& triangles);

}  // namespace hewn
