#include "core/segment/curvature/classify_triangles.h"

namespace hewn {

CurvatureClass classify_curvature(const PrincipalCurvatures& curvature, double diagonal,
                                  const CurvatureOptions& options) {
  const double mean = std::abs(curvature.mean());
  const double larger = std::abs(curvature.max);
  const double smaller = std::abs(curvature.min);
  const bool is_inverted = curvature.max < 0;
  if (mean * diagonal < options.eps_plane) return CurvatureClass::Planar;
  if (larger - smaller < mean * options.eps_sphere) {
    return is_inverted ? CurvatureClass::SphericalInverted : CurvatureClass::Spherical;
  }
  if (larger > mean * options.eps_cone_high && smaller < mean * options.eps_cone_low) {
    return is_inverted ? CurvatureClass::ConicInverted : CurvatureClass::Conic;
  }
  return CurvatureClass::Other;
}

std::vector<CurvatureClass> classify_triangles(const Mesh& mesh,
                                               const std::vector<PrincipalCurvatures>& curvatures,
                                               const CurvatureOptions& options) {
  std::vector<CurvatureClass> classes(mesh.triangles.size(), CurvatureClass::None);
  const double diagonal = mesh.diagonal();
  for (std::size_t t = 0; t < classes.size(); ++t) {
    if (mesh.areas[t] > 0) classes[t] = classify_curvature(curvatures[t], diagonal, options);
  }
  return classes;
}

}  // namespace hewn
