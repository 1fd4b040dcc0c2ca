#include "core/session/selecting.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/segment/edit/selection.h"

namespace hewn {
namespace {

void make_ascending(std::vector<int>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

std::vector<std::vector<int>> neighbors_of(const PreparedMesh& prepared) {
  return group_neighbors(prepared.segmentation, build_topology(*prepared.mesh));
}

bool has_axis(SurfaceKind kind) { return kind != SurfaceKind::Sphere; }

/// A value that a plane may snap to, and what it is called.
template <class T>
struct Candidate {
  T value;
  std::string what;
};

/// Coordinate axes first: they win over equal directions of groups.
std::vector<Candidate<Vec3>> known_directions(const PreparedMesh& prepared) {
  std::vector<Candidate<Vec3>> out;
  out.reserve(3 + prepared.segmentation.groups.size());
  for (int k = 0; k < 3; ++k) out.push_back({Vec3::Unit(k), fmt::format("{} axis", "xyz"[k])});
  for (std::size_t g = 0; g < prepared.segmentation.groups.size(); ++g) {
    const FaceGroup& group = prepared.segmentation.groups[g];
    if (!group.is_fitted || !has_axis(group.surface.kind)) continue;
    out.push_back({group.surface.axis, fmt::format("direction of group {}", g)});
  }
  return out;
}

void snap_direction(const PreparedMesh& prepared, double angle_rad, SnappedPlane& plane) {
  const Vec3 drawn = plane.normal;
  double best = angle_rad;
  for (const Candidate<Vec3>& c : known_directions(prepared)) {
    const Vec3 facing = c.value.dot(drawn) < 0 ? Vec3(-c.value) : c.value;
    const double angle = angle_between(facing, drawn);
    if (angle >= best - 1e-9) continue;
    best = angle;
    plane.normal = facing;
    plane.snapped_to = c.what;
  }
  if (!plane.snapped_to.empty()) return;
  for (int k = 0; k < 3; ++k) {  // a plane that nearly contains an axis
    Vec3 flat = drawn;
    flat[k] = 0;
    if (flat.norm() <= 0.1 || angle_between(flat.normalized(), drawn) >= angle_rad) continue;
    plane.normal = flat.normalized();
    plane.snapped_to = fmt::format("along {}", "xyz"[k]);
    return;
  }
}

/// Where planes, axes and centres of groups lie along the normal.
std::vector<Candidate<double>> known_offsets(const PreparedMesh& prepared, const Vec3& normal) {
  std::vector<Candidate<double>> out;
  for (std::size_t g = 0; g < prepared.segmentation.groups.size(); ++g) {
    const FaceGroup& group = prepared.segmentation.groups[g];
    if (!group.is_fitted) continue;
    const Surface& s = group.surface;
    const double along = std::abs(s.axis.dot(normal));
    const bool is_line = s.kind == SurfaceKind::Cylinder || s.kind == SurfaceKind::Cone;
    if (is_line && along > 1e-9) continue;  // the axis must lie in the plane
    if (s.kind == SurfaceKind::Plane) {
      if (along > 1 - 1e-9) {
        out.push_back({normal.dot(s.axis * s.offset), fmt::format("plane {}", g)});
      }
    } else {
      out.push_back({normal.dot(s.point), fmt::format("middle of {}", g)});
    }
  }
  return out;
}

void snap_offset(const PreparedMesh& prepared, double reach, SnappedPlane& plane) {
  const double drawn = plane.offset;
  std::string what;
  double best = reach;
  for (const Candidate<double>& c : known_offsets(prepared, plane.normal)) {
    if (std::abs(c.value - drawn) >= best) continue;
    best = std::abs(c.value - drawn);
    plane.offset = c.value;
    what = c.what;
  }
  if (!what.empty()) plane.snapped_to += (plane.snapped_to.empty() ? "" : ", ") + what;
}

}  // namespace

std::vector<int> select_like(const PreparedMesh& prepared, const std::vector<int>& selected,
                             Likeness likeness) {
  Similarity similarity;
  similarity.length = 1e-4 * prepared.mesh->diagonal();
  similarity.same_radius = likeness == Likeness::Radius;
  similarity.parallel = likeness == Likeness::Parallel;
  similarity.coaxial = likeness == Likeness::Coaxial;
  std::vector<int> out = selected;
  for (const int g : selected) {
    const std::vector<int> like = select_similar(prepared.segmentation, g, similarity);
    out.insert(out.end(), like.begin(), like.end());
  }
  make_ascending(out);
  return out;
}

std::vector<int> grown(const PreparedMesh& prepared, const std::vector<int>& selected) {
  return grow_groups(neighbors_of(prepared), selected);
}

std::vector<int> shrunk(const PreparedMesh& prepared, const std::vector<int>& selected) {
  return shrink_groups(neighbors_of(prepared), selected);
}

std::vector<int> combined(const std::vector<int>& selected, const std::vector<int>& picked,
                          Combine how) {
  std::vector<int> out;
  const auto into = std::back_inserter(out);
  switch (how) {
    case Combine::Replace:
      return picked;
    case Combine::Add:
      std::set_union(selected.begin(), selected.end(), picked.begin(), picked.end(), into);
      break;
    case Combine::Remove:
      std::set_difference(selected.begin(), selected.end(), picked.begin(), picked.end(), into);
      break;
    case Combine::Toggle:
      std::set_symmetric_difference(selected.begin(), selected.end(), picked.begin(), picked.end(),
                                    into);
      break;
  }
  return out;
}

SnappedPlane snap_plane(const PreparedMesh& prepared, const Vec3& normal, const Vec3& through,
                        double angle_rad, double reach) {
  SnappedPlane plane;
  plane.normal = normal.normalized();
  snap_direction(prepared, angle_rad, plane);
  plane.offset = plane.normal.dot(through);
  snap_offset(prepared, reach, plane);
  return plane;
}

}  // namespace hewn
