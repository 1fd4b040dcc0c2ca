#pragma once
/// Tunables of segmentation by curvature. Names follow Stroeter et al. 2026, section "Segmentation
/// into Face Groups", which leaves the thresholds' values to the user.
#include "core/base/option_table.h"

namespace hewn {

enum class RegionGrowth : int {
  Flood,  ///< "simple region growing"; groups that no primitive fits are grown by fitting
  Fit,    ///< "region growing based on primitive fitting"
};

enum class NormalWeights : int {
  Area,   ///< as in the paper's equation 2.3
  Angle,  ///< unbiased where strips of triangles alternate around a vertex
};

struct CurvatureOptions {
  double ridge_angle_deg = 25;    ///< phi_r
  double corner_ratio = 0.7;      ///< Jiao 2006: strong direction threshold
  double corner_defect_deg = 60;  ///< Jiao 2006: angle defect of a sharp corner
  double eps_plane = 0.1;         ///< over the bounding box's diagonal
  double eps_sphere = 0.3;
  double eps_cone_low = 0.3;
  double eps_cone_high = 1.5;
  int normal_weights = static_cast<int>(NormalWeights::Area);
  int growth = static_cast<int>(RegionGrowth::Fit);
  int region_triangles = 24;
  double fit_distance = 5e-4;  ///< of the diagonal; the paper's eps^d
  double fit_normal_deg = 15;  ///< the paper's eps^n
};

template <>
std::span<const OptionField<CurvatureOptions>> option_table<CurvatureOptions>();

}  // namespace hewn
