#pragma once
/// What regularisation knows about each face group: its fit, the vertices that carry it, and how
/// exact it is.
#include <vector>

#include "core/fit/face_groups.h"
#include "core/fit/gauss_newton.h"

namespace hewn {

struct FitItem {
  int group = 0;
  Surface surface;
  /// Vertices that lie on the surface within the noise when enough do (others were cut by
  /// neighbouring faces and lie on chords), else all vertices.
  std::vector<Vec3> points;
  Vec3 center = Vec3::Zero();  ///< area-weighted, of the triangles that carry the fit
  double sigma = 0;            ///< deviation of `points`
  double extent = 0;           ///< diagonal of the group's box
  double area = 0;
  int direction = -1;
  FitDeviation deviation;
};

/// How far a vertex on a surface may be off it by rounding and noise; model units.
double exact_reach(double diagonal, double noise);

/// One item for each group that is not negligible, largest area first; groups that are not fitted
/// only with `keep_free_form`.
std::vector<FitItem> collect_items(const Mesh& mesh, const Segmentation& segmentation,
                                   bool keep_free_form);

}  // namespace hewn
