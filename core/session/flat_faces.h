#pragma once
/// The flat faces of a solid, each of which is shown as part of one literal however many are flush
/// in it.
#include <cstdint>
#include <vector>

#include "core/csg/tree.h"
#include "core/mesh/mesh.h"

namespace hewn {

/// Triangles in one plane that hang together.
struct FlatFace {
  Vec3 normal = Vec3::Zero();
  double offset = 0;  ///< of the plane along `normal`
  Box3 box;
  double area = 0;
  int label = -1;
};

/// Gives each flat face one label, that of most of its area: coplanar faces of several literals are
/// tessellated together, in triangles that belong to none of them alone. Returns the faces.
/// Cost: O(triangles log triangles).
std::vector<FlatFace> unify_flat_faces(const Mesh& mesh, std::vector<int>& labels);

/// As what the flat ends of each literal are shown, six numbers a literal (by axis, the lower end
/// first): the label of the largest face that an end lies in, else the literal itself. `near`: what
/// coplanar may be off by. Cost: O(faces x literals).
std::vector<std::int32_t> shown_labels(const Tree& tree, const std::vector<FlatFace>& faces,
                                       double near);

}  // namespace hewn
