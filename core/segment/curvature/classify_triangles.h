#pragma once
/// Stage 5: the kind of surface that a triangle's curvature suggests.
#include <cstdint>
#include <vector>

#include "core/segment/curvature/principal_curvatures.h"

namespace hewn {

enum class CurvatureClass : std::uint8_t {
  Planar,
  Spherical,
  SphericalInverted,  ///< hollow: seen from inside the sphere
  Conic,
  ConicInverted,
  Other,  ///< none of the paper's: a torus, a saddle, a transition
  None,   ///< a triangle without area
};

/// The paper's conditions, in its order: planar, spherical, conic. `diagonal` is the bounding
/// box's. Compares against |H|: an inverted sphere has negative curvatures.
CurvatureClass classify_curvature(const PrincipalCurvatures& curvature, double diagonal,
                                  const CurvatureOptions& options);

/// One class for each triangle.
std::vector<CurvatureClass> classify_triangles(const Mesh& mesh,
                                               const std::vector<PrincipalCurvatures>& curvatures,
                                               const CurvatureOptions& options);

}  // namespace hewn
