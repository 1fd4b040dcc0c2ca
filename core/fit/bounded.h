#pragma once
/// Bounded primitives from face groups (Stroeter et al. 2026, section "Primitive Fitting"): what a
/// tree may be composed of when it is searched over solids instead of halfspaces.
#include <optional>
#include <vector>

#include "core/base/option_table.h"
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/literal.h"
#include "core/fit/surface_set.h"

namespace hewn {

enum class BoundedKind {
  Cylinder,  ///< between capping planes, or the group's own extent where there is none
  Cone,      ///< the same for a cone: a frustum, or up to the apex
  Sphere,
  Torus,
  Cuboid,      ///< from pairs of parallel planes; "ghost" sides come from the extent of a face
  Fillet,      ///< compound: a box beyond the chord plane minus the cylinder or cone
  ExtraPlane,  ///< a side of a curved group's oriented bounding box, as a box over the whole part
  SeparatingPlane,  ///< through the rim of a part of a sphere or torus, as a box over the part
};

/// A solid, or the difference of two.
struct BoundedPrimitive {
  BoundedKind kind = BoundedKind::Cuboid;
  Literal literal;
  std::optional<Literal> minus;  ///< taken away from `literal`; compounds only
  std::vector<int> groups;       ///< face groups on its surface, ascending
  std::vector<int> halfspaces;   ///< of the surface set on its surface, ascending

  /// Negative inside. A bound near the rim of a compound.
  double signed_distance(const Vec3& x) const;
};

struct BoundedOptions {
  double snap = 2e-4;  ///< share of the diagonal within which an extent ends at a plane
  int min_sides = 4;   ///< of a cuboid that lie on planes of the part
  bool extra_planes = true;
  bool fillets = true;
};

template <>
std::span<const OptionField<BoundedOptions>> option_table<BoundedOptions>();

/// All bounded primitives, each once, ordered by kind and then by the first group that gave rise to
/// it. Requires: `surfaces` made from this mesh and segmentation.
///
/// Fails with: Cancelled. Cost: O(n log n) plus O(planar groups x directions x planes).
/// Deterministic; one thread.
Result<std::vector<BoundedPrimitive>> build_bounded_primitives(const Mesh& mesh,
                                                               const Segmentation& segmentation,
                                                               const SurfaceSet& surfaces,
                                                               const BoundedOptions& options,
                                                               const RunContext& run);

/// "cylinder", "cone", "sphere", "torus", "cuboid", "fillet", "extra plane", "separating plane".
const char* name_of(BoundedKind kind);

}  // namespace hewn
