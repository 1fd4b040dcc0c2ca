#pragma once
/// The surfaces of a tree's literals, and those of them that a tree of the same solid is built
/// from. Internal to rebuild.
#include <vector>

#include "core/csg/tree_inside.h"
#include "core/csg/tree_ray.h"
#include "core/mesh/mesh.h"
#include "core/sample/frame.h"
#include "core/sample/sample_table.h"
#include "core/synth/rebuild/boundary.h"
#include "core/synth/rebuild/tree_surfaces.h"

namespace hewn {

/// A solid to build anew.
struct GivenSolid {
  TreeInside inside;
  TreeRays rays;
  double scale;  ///< its diagonal
  double depth;  ///< points nearer to its surface than this are free; model units
};

class BoundingSurfaces {
 public:
  /// Lines through `points` look for the boundary, too. The references must outlive this.
  BoundingSurfaces(const GivenSolid& solid, const std::vector<Vec3>& points, const RunContext& run)
      : solid_(solid), points_(points), run_(run) {}

  /// Finds the surfaces of all literals, once. False when some have none, and without an end.
  bool find_all();
  /// Finds those among them that bound the solid even beyond the depth that is free, once, and
  /// takes them into use. False when there are none to search with.
  bool find_bounding();
  /// Those that bound the solid for sure, seen by a few lines only. Requires: `find_all()`.
  std::vector<Halfspace> surely_bounding() const;

  /// Also takes the surface into use that best parts points of both kinds; false: none does. Each
  /// list has the points of one cell as rows of the table.
  bool use_separating(const SampleTable& table, const std::vector<std::vector<int>>& mixed);

  const std::vector<Halfspace>& all() const { return known_.all.halfspaces; }
  const SurfaceSet& used() const { return used_; }
  /// Where the bounding ones were met; `index_in_used` of the hits' halfspaces.
  const std::vector<BoundaryHit>& hits() const { return hits_; }
  std::size_t index_in_used(const BoundaryHit& hit) const {
    return static_cast<std::size_t>(place_[static_cast<std::size_t>(hit.halfspace)] - 1);
  }
  /// A box that ends at planes where the solid does, else a little further out.
  const Frame& frame() const { return frame_; }
  /// The frame's corners, as a mesh without triangles: the extent of the solid.
  const Mesh& extent() const { return extent_; }

 private:
  bool changes_label(const BoundaryHit& hit) const;
  bool is_deep(const BoundaryHit& hit) const;
  void use(std::size_t halfspace);
  int best_separating(const SampleTable& table, const std::vector<std::vector<int>>& mixed) const;
  void find_frame_of(const std::vector<BoundaryHit>& hits);

  const GivenSolid& solid_;
  const std::vector<Vec3>& points_;
  const RunContext& run_;
  bool has_looked_ = false;
  TreeSurfaces known_;
  std::vector<int> place_;  ///< of `known_`: index into `used_` plus one, else 0
  SurfaceSet used_;
  std::vector<BoundaryHit> hits_;
  Frame frame_;
  Mesh extent_;
};

}  // namespace hewn
