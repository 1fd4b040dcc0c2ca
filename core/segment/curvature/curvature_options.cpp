#include "core/segment/curvature/curvature_options.h"

namespace hewn {

template <>
std::span<const OptionField<CurvatureOptions>> option_table<CurvatureOptions>() {
  using O = CurvatureOptions;
  static constexpr OptionField<O> kTable[] = {
      {"ridge-angle", &O::ridge_angle_deg, 1, 90,
       "Degrees between neighbouring triangles above which their edge is sharp."},
      {"corner-ratio", &O::corner_ratio, 0, 1,
       "Smallest over middle eigenvalue of the normals' tensor from which a vertex is a corner."},
      {"corner-defect", &O::corner_defect_deg, 1, 360,
       "Degrees by which the angles at a vertex miss a full turn from which it is a corner."},
      {"eps-plane", &O::eps_plane, 0, 10,
       "Mean curvature times the bounding box's diagonal below which a triangle is planar."},
      {"eps-sphere", &O::eps_sphere, 0, 2,
       "Difference of the principal curvatures, in mean curvatures, for spherical triangles."},
      {"eps-cone-low", &O::eps_cone_low, 0, 2,
       "Smaller principal curvature of a conic triangle, in mean curvatures, at most."},
      {"eps-cone-high", &O::eps_cone_high, 0, 2,
       "Larger principal curvature of a conic triangle, in mean curvatures, at least."},
      {"normal-weights", &O::normal_weights, 0, 1, "Weight of a triangle in a vertex's normal.",
       "area,angle"},
      {"growth", &O::growth, 0, 1, "How triangles of like curvature become groups.", "flood,fit"},
      {"region-triangles", &O::region_triangles, 4, 1000,
       "Triangles in a region before its primitive is first fitted."},
      {"fit-distance", &O::fit_distance, 0, 0.1,
       "Largest distance from a group's surface, as a share of the diagonal."},
      {"fit-normal", &O::fit_normal_deg, 0.1, 90,
       "Degrees between a triangle's normal and its surface's normal, at most."},
  };
  return kTable;
}

}  // namespace hewn
