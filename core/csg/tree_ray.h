#pragma once
/// Rays through CSG trees: exact crossings per literal, combined as intervals (Roth 1982).
#include <memory>
#include <vector>

#include "core/csg/bounds_table.h"
#include "core/csg/literal_bounds.h"
#include "core/csg/tree.h"
#include "core/mesh/query.h"

namespace hewn {

/// Where a ray enters or leaves the solid.
struct TreeCrossing {
  double t = kInfinity;  ///< in lengths of the direction
  int literal = -1;      ///< whose boundary is crossed; index into `Tree::literals`
  int face = 0;          ///< of the literal: box 0..5; cylinder 0 flank, 1 bottom, 2 top; else 0
};

/// A stretch of a ray inside the solid.
struct TreeInterval {
  TreeCrossing enter, leave;
};

/// What a ball around a point has of a solid.
enum class Nearby : char { Nothing, All, Surface };

/// Scratch memory of one thread; keeps casting free of allocations.
struct TreeRayScratch {
  std::vector<std::vector<TreeInterval>> lists;
  std::vector<Nearby> nearby;  ///< by node; read below nodes with a surface only
};

/// Immutable once built; thread-safe. The tree must outlive it.
class TreeRays {
 public:
  explicit TreeRays(const Tree& tree);

  /// All stretches with t > 0 inside the solid, ascending. Cost: O(literals) for small results.
  const std::vector<TreeInterval>& cast(const Vec3& origin, const Vec3& direction,
                                        TreeRayScratch& scratch) const;
  /// What the ball of radius `reach` around a point has of the tree's solid, for `cast_nearby`.
  /// `Surface` when in doubt. Cost: the distances of literals near the ball.
  Nearby look_around(const Vec3& center, double reach, TreeRayScratch& scratch) const;
  /// The same as `cast` in the ball last looked at, whose centre is the origin; what lies beyond
  /// may be missing or wrong. Only nodes with a surface in the ball are visited.
  const std::vector<TreeInterval>& cast_nearby(const Vec3& origin, const Vec3& direction,
                                               TreeRayScratch& scratch) const;
  /// The stretches inside one literal with leave.t > 0, ascending; replaces `out`.
  void cast_literal(int literal, const Vec3& origin, const Vec3& direction,
                    std::vector<TreeInterval>& out) const;
  /// Those of all literals, by literal; replaces `out`.
  void cast_literals(const Vec3& origin, const Vec3& direction,
                     std::vector<TreeInterval>& out) const;
  /// The unit normal at a crossing's position, on the side that `direction` comes from: outward
  /// for the ray's own direction where it enters, for the opposite one where it leaves.
  Vec3 normal(const TreeCrossing& crossing, const Vec3& position, const Vec3& direction) const;
  const Tree& tree() const { return *tree_; }

 private:
  struct Ray;
  const std::vector<TreeInterval>& cast(const Ray& ray, TreeRayScratch& scratch) const;
  void cast_node(int node, const Ray& ray, std::size_t depth, TreeRayScratch& scratch) const;
  Nearby look_around(int node, const Vec3& center, double reach, std::vector<Nearby>& nearby) const;
  void append_literal(int literal, const Ray& ray, std::vector<TreeInterval>& out) const;
  void append_met(int literal, const Ray& ray, std::vector<TreeInterval>& out) const;

  const Tree* tree_;
  std::vector<LiteralBounds> bounds_;                     ///< of each literal
  BoundsTable table_;                                     ///< of the bounds
  std::vector<std::shared_ptr<const MeshQuery>> meshes_;  ///< of polyhedra, else null
};

}  // namespace hewn
