#pragma once
/// The smooth pieces of literals' boundaries, each as a map of the unit square.
#include <vector>

#include "core/csg/tree.h"

namespace hewn {

enum class PatchShape { BoxSide, Side, Cap, PrismSide, PrismCap, Sphere, Torus, Facet };

struct BoundaryPatch {
  PatchShape shape = PatchShape::BoxSide;
  int literal = 0;
  int part = 0;  ///< which of them: twice the axis plus one if upper; a prism's side; a triangle
  bool is_flat = true;
  bool is_orthogonal = false;  ///< lines of constant u and v meet at right angles everywhere
  /// Facets that stand for the patch in pictures, along u and v: powers of two.
  int u_facets = 1, v_facets = 1;
  /// No line of constant v (u) is longer; model units.
  double u_length = 0, v_length = 0;
  /// Whether the surface ends, with an edge, at u = 0, u = 1, v = 0, v = 1.
  bool ends[4] = {false, false, false, false};
};

struct PatchPoint {
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit, away from the literal
};

/// Flat patches and straight directions go on beyond the unit square.
PatchPoint point_on(const Literal& literal, const BoundaryPatch& patch, double u, double v);

/// The patches of all literals, in their order. Facets deviate from curved surfaces by at most
/// `deflection` (model units), within sense. Cost: O(patches).
std::vector<BoundaryPatch> boundary_patches(const Tree& tree, double deflection);

}  // namespace hewn
