#include "core/segment/segment.h"

#include "core/segment/curvature/curvature.h"
#include "core/segment/facet_method.h"

namespace hewn {

template <>
std::span<const OptionField<SegmentOptions>> option_table<SegmentOptions>() {
  using O = SegmentOptions;
  static constexpr OptionField<O> kFields[] = {
      {"method", &O::method, 0, 1, "how face groups are found", "facets,curvature"},
      {"noise", &O::noise, 0, 1e-3,
       "deviation of the vertices as a share of the diagonal; 0 estimates it"},
      {"plane-tolerance", &O::plane_tolerance, 1e-8, 1e-3,
       "distance of a vertex from its flat facet, as a share of the diagonal"},
      {"vertex-tolerance", &O::vertex_tolerance, 1e-8, 1e-3,
       "distance of an exact vertex from its surface, as a share of the diagonal"},
      {"max-deviation", &O::max_deviation, 1e-6, 1e-2,
       "distance of a vertex from a surface that is not exact, as a share of the diagonal"},
      {"smooth-angle", &O::smooth_angle_deg, 1, 60,
       "degrees by which neighbouring facets of one curved surface may turn"},
      {"max-looseness", &O::max_looseness, 0.1, 10,
       "largest deviation of a curved surface, in tenths of its facets' depth"},
      {"loose-factor", &O::loose_factor, 1, 100,
       "a second try with vertex tolerances times this, kept where it finds fewer groups"},
      {"seeds", &O::seeds, 1, 1000, "seeds tried for each curved group"},
      {"max-failures", &O::max_failures, 1, 1000,
       "rounds of seeds in vain before a smooth component is given up"},
  };
  return kFields;
}

Result<Segmentation> segment(const Mesh& mesh, const SegmentOptions& options,
                             const RunContext& run) {
  if (mesh.triangles.empty() || !(mesh.total_area > 0)) {
    return Error{ErrorCode::BadMesh,
                 "the mesh has no triangle with an area: check the file it came from"};
  }
  if (options.method == static_cast<int>(SegmentMethod::Facets)) {
    return segment_by_facets(mesh, options, run);
  }
  if (options.method == static_cast<int>(SegmentMethod::Curvature)) {
    return segment_by_curvature(mesh, options, run);
  }
  return Error{ErrorCode::InvalidArgument, "unknown segmentation method; use facets or curvature"};
}

}  // namespace hewn
