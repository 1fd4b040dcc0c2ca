#include "core/sample/frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

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

/// The axes of cylinders and cones along `along`, each once, as points on the plane across it.
std::vector<Vec3> axes_along(const SurfaceSet& surfaces, const Vec3& along, double same) {
  std::vector<Vec3> axes;
  for (const Halfspace& h : surfaces.halfspaces) {
    const Surface& s = h.surface;
    const bool has_axis = s.kind == SurfaceKind::Cylinder || s.kind == SurfaceKind::Cone;
    if (!has_axis || h.is_separating || s.axis.cross(along).norm() > kOrthogonal) continue;
    const Vec3 at = s.point - s.point.dot(along) * along;
    const auto is_here = [&](const Vec3& a) { return (a - at).norm() < same; };
    if (std::none_of(axes.begin(), axes.end(), is_here)) axes.push_back(at);
  }
  return axes;
}

int coordinate_of(const Vec3& v) {
  int k = 0;
  v.cwiseAbs().maxCoeff(&k);
  return std::abs(std::abs(v[k]) - 1) < kOrthogonal ? k : -1;
}

/// The direction in which most pairs of parallel axes lie, a coordinate axis before all others.
/// Nothing with fewer than two axes, or with many of them.
std::optional<Vec3> direction_between_axes(const SurfaceSet& surfaces, const Vec3& along,
                                           double size) {
  constexpr std::size_t kMostAxes = 64;
  constexpr double kSameAxis = 1e-4;       // of the size
  constexpr double kSameDirection = 1e-4;  // radians
  const std::vector<Vec3> axes = axes_along(surfaces, along, kSameAxis * size);
  if (axes.size() < 2 || axes.size() > kMostAxes) return std::nullopt;
  std::vector<std::pair<Vec3, int>> found;  // with the number of pairs
  for (std::size_t b = 1; b < axes.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const Vec3 d = (axes[b] - axes[a]).normalized();
      if (const int k = coordinate_of(d); k >= 0) return Vec3(Vec3::Unit(k));
      const auto it = std::find_if(found.begin(), found.end(), [&](const auto& f) {
        return f.first.cross(d).norm() < kSameDirection;
      });
      if (it == found.end()) {
        found.emplace_back(d, 1);
      } else {
        ++it->second;
      }
    }
  }
  const auto most = std::max_element(
      found.begin(), found.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most->first;
}

/// Whether nothing but one plane has the direction, as the flank of a lever.
bool is_lone_plane(const SurfaceSet& surfaces, int direction) {
  int planes = 0;
  for (const Halfspace& h : surfaces.halfspaces) {
    if (h.direction != direction) continue;
    if (h.surface.kind != SurfaceKind::Plane) return false;
    ++planes;
  }
  return planes == 1;
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
    // A lone plane tells less than how holes and bosses lie.
    const bool is_weak =
        chosen.size() == 1 || (chosen.size() == 2 && is_lone_plane(surfaces, chosen[1]));
    const auto between =
        is_weak ? direction_between_axes(surfaces, first, mesh.diagonal()) : std::nullopt;
    if (between) {
      second = (*between - between->dot(first) * first).normalized();
      chosen.resize(1);
    } else if (chosen.size() > 1) {
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
