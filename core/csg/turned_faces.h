#pragma once
/// Coincident faces that are not parallel to the axes.
#include "core/csg/tree.h"

namespace hewn {

/// Nearly the same solid, without turned faces that lie in one plane and have to cancel there: a
/// tool's that ends flush with what it cuts, or two abutting solids'. Modellers round the corners
/// of turned literals, so such faces miss each other by a rounding error and leave sheets or cracks
/// as large as the faces. Of each two, the face that decides is moved out of its literal by a round
/// amount of at most 1e-5 of the diagonal, so that solids overlap and tools reach through; of more,
/// one beyond the other. Faces
/// parallel to the tree's main axes (those of most literals) have equal coordinates and stay,
/// unless they meet the side of a prism; what meets such a side moves, out or in, since the side
/// cannot. Cost: O(literals^2) comparisons of planes.
Tree with_turned_faces_apart(const Tree& tree);

}  // namespace hewn
