#pragma once
/// How the mesh approximates a curved surface: number of sides and phase of its facets.
#include <vector>

#include "core/csg/literal.h"
#include "core/fit/face_groups.h"

namespace hewn {

/// The regular tessellation of `surface` by the facets of `groups`; `sides` is 0 when the facets'
/// azimuths are not evenly spaced. Phases are measured about `surface.axis` from
/// `reference_frame(surface.axis).u`, in [0, one step).
/// Returns zeros when the segmentation holds no facets.
Facets detect_tessellation(const Surface& surface, const std::vector<int>& groups, const Mesh& mesh,
                           const Segmentation& segmentation);

/// The coordinate axis about which a sphere is cut into rings and sides as OpenSCAD does it (rings
/// at half steps from the poles, a vertex at azimuth zero), with their numbers. `sides` is 0 and
/// the axis z when no axis fits.
struct SphereTessellation {
  Vec3 axis = Vec3::UnitZ();
  Facets facets;
};
SphereTessellation detect_sphere_tessellation(const Surface& sphere, const std::vector<int>& groups,
                                              const Mesh& mesh, const Segmentation& segmentation);

}  // namespace hewn
