#pragma once
/// Face groups: triangles with the surface fitted to them. Segmentation makes them, regularisation
/// reads them.
#include <vector>

#include "core/csg/surface.h"
#include "core/mesh/mesh.h"

namespace hewn {

/// Triangles that lie on one surface.
struct FaceGroup {
  Surface surface;
  std::vector<int> triangles;  ///< ascending
  double area = 0;
  /// +1: the mesh's normals agree with the surface's gradient (a boss), -1: opposed (a hole).
  int side = 1;
  /// Largest distance of the group's vertices and facet centres from the surface.
  double max_deviation = 0;
  /// Root mean square distance of the vertices.
  double rms_deviation = 0;
  /// False when no primitive explains the triangles (a fallback plane or free-form patch).
  bool is_fitted = true;
};

/// Planar runs of triangles: what the designer's tessellator emitted as one flat face.
struct Facet {
  std::vector<int> triangles;
  Vec3 normal = Vec3::Zero();
  Vec3 centroid = Vec3::Zero();
  double area = 0;
};

struct Segmentation {
  std::vector<FaceGroup> groups;
  std::vector<int> group_of_triangle;  ///< -1: zero-area leftovers
  std::vector<Facet> facets;           ///< empty for methods that do not build them
  std::vector<int> facet_of_triangle;
  double noise = 0;  ///< estimated deviation of vertices from their surfaces, model units
};

}  // namespace hewn
