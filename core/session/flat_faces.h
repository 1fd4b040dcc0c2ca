#pragma once
/// The flat faces of a mesh, each of which is shown as part of one literal however many are flush
/// in it.
#include <vector>

#include "core/mesh/mesh.h"

namespace hewn {

/// Gives each flat face one label, that of most of its area. Cost: O(triangles log triangles).
void unify_flat_faces(const Mesh& mesh, std::vector<int>& labels);

}  // namespace hewn
