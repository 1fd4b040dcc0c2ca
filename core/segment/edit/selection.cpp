#include "core/segment/edit/selection.h"

#include <algorithm>

namespace hewn {
namespace {

std::vector<int> as_list(const std::vector<bool>& mask) {
  std::vector<int> list;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i]) list.push_back(static_cast<int>(i));
  }
  return list;
}

/// Spreads membership (`value` true) or its absence (false) to neighbours; -1 is no neighbour.
template <class Neighbors>
std::vector<int> spread(const Neighbors& neighbors, std::span<const int> selected, int steps,
                        bool value) {
  std::vector<bool> mask(neighbors.size(), false);
  for (const int i : selected) mask[i] = true;
  for (int step = 0; step < steps; ++step) {
    std::vector<bool> next = mask;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (mask[i] != value) continue;
      for (const int other : neighbors[i]) {
        if (other >= 0) next[other] = value;
      }
    }
    mask.swap(next);
  }
  return as_list(mask);
}

bool has_axis(const Surface& s) { return s.kind != SurfaceKind::Sphere; }

bool is_parallel(const Surface& a, const Surface& b, double angle_rad) {
  if (!has_axis(a) || !has_axis(b)) return false;
  const double angle = angle_between(a.axis, b.axis);
  return std::min(angle, kPi - angle) <= angle_rad;
}

bool is_on_axis(const Surface& line, const Vec3& point, double length) {
  const Vec3 d = point - line.point;
  return (d - line.axis * line.axis.dot(d)).norm() <= length;
}

/// A plane has no axis line of its own: one across the other's axis is coaxial with it.
bool is_coaxial(const Surface& a, const Surface& b, const Similarity& s) {
  if (a.kind == SurfaceKind::Plane || b.kind == SurfaceKind::Plane) {
    return is_parallel(a, b, s.angle_rad);
  }
  if (has_axis(a) && has_axis(b) && !is_parallel(a, b, s.angle_rad)) return false;
  if (has_axis(a)) return is_on_axis(a, b.point, s.length);
  if (has_axis(b)) return is_on_axis(b, a.point, s.length);
  return (a.point - b.point).norm() <= s.length;
}

bool has_same_radius(const Surface& a, const Surface& b, const Similarity& s) {
  const auto both = [&](SurfaceKind kind) { return a.kind == kind && b.kind == kind; };
  const auto either = [&](SurfaceKind kind) { return a.kind == kind || b.kind == kind; };
  if (both(SurfaceKind::Plane)) return true;
  if (both(SurfaceKind::Cone)) return std::abs(a.half_angle_rad - b.half_angle_rad) <= s.angle_rad;
  if (either(SurfaceKind::Plane) || either(SurfaceKind::Cone)) return false;
  if (both(SurfaceKind::Torus) && std::abs(a.major_radius - b.major_radius) > s.length) {
    return false;
  }
  return std::abs(a.radius - b.radius) <= s.length;
}

bool is_similar(const FaceGroup& a, const FaceGroup& b, const Similarity& s) {
  if (s.same_kind && a.surface.kind != b.surface.kind) return false;
  // A plane's side says nothing: its fitted normal may point either way.
  const bool is_plane = a.surface.kind == SurfaceKind::Plane;
  if (s.same_kind && !is_plane && a.side != b.side) return false;
  if (s.parallel && !is_parallel(a.surface, b.surface, s.angle_rad)) return false;
  if (s.coaxial && !is_coaxial(a.surface, b.surface, s)) return false;
  return !s.same_radius || has_same_radius(a.surface, b.surface, s);
}

}  // namespace

std::vector<std::vector<int>> group_neighbors(const Segmentation& segmentation,
                                              const TriangleTopology& topology) {
  std::vector<std::vector<int>> neighbors(segmentation.groups.size());
  const std::vector<int>& group = segmentation.group_of_triangle;
  for (std::size_t t = 0; t < group.size(); ++t) {
    for (const int other : topology.neighbors[t]) {
      if (other < 0 || group[t] < 0 || group[other] < 0 || group[t] == group[other]) continue;
      neighbors[group[t]].push_back(group[other]);
    }
  }
  for (std::vector<int>& list : neighbors) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbors;
}

std::vector<int> grow_triangles(const TriangleTopology& topology, std::span<const int> selected,
                                int steps) {
  return spread(topology.neighbors, selected, steps, true);
}

std::vector<int> shrink_triangles(const TriangleTopology& topology, std::span<const int> selected,
                                  int steps) {
  return spread(topology.neighbors, selected, steps, false);
}

std::vector<int> grow_groups(const std::vector<std::vector<int>>& neighbors,
                             std::span<const int> selected, int steps) {
  return spread(neighbors, selected, steps, true);
}

std::vector<int> shrink_groups(const std::vector<std::vector<int>>& neighbors,
                               std::span<const int> selected, int steps) {
  return spread(neighbors, selected, steps, false);
}

std::vector<int> select_similar(const Segmentation& segmentation, int example,
                                const Similarity& similarity) {
  std::vector<int> similar;
  const FaceGroup& wanted = segmentation.groups[example];
  for (int g = 0; g < static_cast<int>(segmentation.groups.size()); ++g) {
    if (g == example || is_similar(wanted, segmentation.groups[g], similarity)) {
      similar.push_back(g);
    }
  }
  return similar;
}

}  // namespace hewn
