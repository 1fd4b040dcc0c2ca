#pragma once
/// Items as they come out of the fits of arcs.
#include <utility>
#include <vector>

#include "core/fit/fit_items.h"

namespace hewn::testing {

/// A cylinder along z, fitted to `points` from a guess; in the first direction.
inline FitItem fitted_arc(std::vector<Vec3> points, const Vec3& center, double radius) {
  FitItem item;
  item.points = std::move(points);
  item.surface.kind = SurfaceKind::Cylinder;
  item.surface.point = center;
  item.surface.radius = radius;
  FitSettings settings;
  settings.keep_axis = true;
  settings.max_iterations = 50;
  settings.min_decrease = 1e-12;
  refine_surface(item.surface, {item.points}, settings);
  item.sigma = rms_distance(item.surface, item.points);
  item.deviation = fit_deviation(item.surface, item.points, item.sigma, true);
  item.direction = 0;
  return item;
}

}  // namespace hewn::testing
