#pragma once
/// Cylinders and cones from the planes of their facets. However a regular tessellation is trimmed,
/// its planes still touch the inscribed surface, while the new corners lie on no surface at all.
#include <optional>
#include <span>

#include "core/csg/surface.h"

namespace hewn {

/// The plane of a facet.
struct TangentPlane {
  Vec3 normal = Vec3::UnitZ();  ///< unit, along the surface's gradient
  Vec3 point = Vec3::Zero();    ///< in the middle of the facet
  double weight = 1;            ///< the facet's area
  double reach = 0;             ///< from the point to the facet's furthest corner
};

struct InscribedFit {
  Surface surface;
  double rms_distance = 0;  ///< by which the planes miss it, within their reach
};

/// The cylinder or cone that the planes touch; `near` tells which kind, and roughly where. Weighted
/// least squares in closed form. Nothing for other kinds, and when the planes tell no cone.
std::optional<InscribedFit> inscribed_fit(const Surface& near,
                                          std::span<const TangentPlane> planes);

/// The angle about the axis between two neighbouring planes whose normals differ by `turn_rad`.
double step_about_axis(const Surface& inscribed, double turn_rad);

/// The surface on which the corners lie that planes `step_rad` apart have between them.
Surface circumscribed(const Surface& inscribed, double step_rad);

}  // namespace hewn
