#pragma once
/// What all patches of a tree's boundary are cut by.
#include <vector>

#include "core/csg/boundary/boundary_patch.h"
#include "core/csg/literal_bounds.h"
#include "core/csg/tree_inside.h"

namespace hewn {

/// The tree must outlive it. Thread-safe.
struct BoundaryModel {
  const Tree& tree;
  double diagonal;
  double finest;  ///< cells of patches are not cut into smaller ones; model units
  std::vector<LiteralBounds> bounds;
  std::vector<BoundaryPatch> patches;
  TreeInside solid;

  BoundaryModel(const Tree& t, double of_model, double smallest)
      : tree(t),
        diagonal(of_model),
        finest(smallest),
        patches(boundary_patches(t, kDeflection * of_model)),
        solid(t) {
    for (const Literal& s : t.literals) bounds.emplace_back(s);
  }

  const Literal& literal_of(const BoundaryPatch& patch) const {
    return tree.literals[static_cast<std::size_t>(patch.literal)];
  }
  /// As `distance_within`.
  double distance(int literal, const Vec3& p, double reach) const {
    const auto l = static_cast<std::size_t>(literal);
    return distance_within(tree.literals[l], bounds[l], p, reach);
  }
  /// Of facets from round surfaces; share of the diagonal.
  static constexpr double kDeflection = 2e-4;
  /// Surfaces nearer than this coincide; model units.
  double same() const { return 2e-6 * diagonal; }
};

}  // namespace hewn
