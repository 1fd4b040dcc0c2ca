#include "core/sample/frame.h"

#include <array>
#include <cmath>

namespace hewn {
namespace {

constexpr double kOrthogonal = 1e-6;

std::vector<double> area_per_direction(const SurfaceSet& surfaces) {
  std::vector<double> area(surfaces.directions.size(), 0.0);
  for (const Halfspace& h : surfaces.halfspaces) {
    if (h.direction >= 0) area[h.direction] += h.area;
  }
  return area;
}

/// The direction with the most area among those orthogonal to all of `to`; -1 when there is none.
int largest_orthogonal(const std::vector<Vec3>& directions, const std::vector<double>& area,
                       const std::vector<int>& to) {
  int best = -1;
  for (int i = 0; i < static_cast<int>(directions.size()); ++i) {
    bool fits = area[i] > 0;
    for (const int k : to) {
      fits = fits && std::abs(directions[i].dot(directions[k])) < kOrthogonal;
    }
    if (fits && (best < 0 || area[i] > area[best])) best = i;
  }
  return best;
}

bool is_coordinate_axis(const Vec3& v) { return std::abs(v.cwiseAbs().maxCoeff() - 1) < 1e-12; }

/// Columns in an order and with signs that make the identity the choice for aligned parts.
Mat3 tidy(std::array<Vec3, 3> axes) {
  bool aligned = true;
  for (const Vec3& a : axes) aligned = aligned && is_coordinate_axis(a);
  if (aligned) return Mat3::Identity();
  Mat3 m;
  for (int k = 0; k < 3; ++k) {
    int largest = 0;
    axes[k].cwiseAbs().maxCoeff(&largest);
    m.col(k) = axes[k][largest] < 0 ? Vec3(-axes[k]) : axes[k];
  }
  if (m.determinant() < 0) m.col(2) = -m.col(2);
  return m;
}

}  // namespace

Frame find_frame(const Mesh& mesh, const std::vector<int>& triangles, const SurfaceSet& surfaces) {
  Frame frame;
  const std::vector<double> area = area_per_direction(surfaces);
  std::vector<int> chosen;
  while (chosen.size() < 3) {
    const int next = largest_orthogonal(surfaces.directions, area, chosen);
    if (next < 0) break;
    chosen.push_back(next);
  }
  if (!chosen.empty()) {
    const Vec3& first = surfaces.directions[chosen[0]];
    Vec3 second;
    if (chosen.size() > 1) {
      second = surfaces.directions[chosen[1]];
    } else {
      second = is_coordinate_axis(first)
                   ? Vec3::Unit(std::abs(first.x()) > 0.5 ? 1 : (std::abs(first.y()) > 0.5 ? 2 : 0))
                   : tangents(first).u;
    }
    const Vec3 third = chosen.size() > 2 ? surfaces.directions[chosen[2]] : first.cross(second);
    frame.rotation = tidy({first, second, third});
  }
  const auto add = [&](const Vec3& p) { frame.box.extend(frame.to_local(p)); };
  if (triangles.empty()) {
    for (const Vec3& p : mesh.vertices) add(p);
  }
  for (const int t : triangles) {
    for (int k = 0; k < 3; ++k) add(mesh.corner(t, k));
  }
  return frame;
}

}  // namespace hewn
