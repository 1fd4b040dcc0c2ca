#include "core/session/measuring.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace hewn {
namespace {

constexpr double kParallel_rad = 1e-3;

/// What a spot stands for. The order of the kinds is that of the cases below.
struct Datum {
  enum class Kind { Point, Axis, Plane } kind = Kind::Point;
  Vec3 point = Vec3::Zero();      ///< of the datum, next to the spot
  Vec3 direction = Vec3::Zero();  ///< unit: along the axis, or the plane's normal
  const char* name = "point";

  bool is_point() const { return kind == Kind::Point; }
  Vec3 foot(const Vec3& p) const {
    const Vec3 off = p - point;
    switch (kind) {
      case Kind::Axis:
        return point + direction * direction.dot(off);
      case Kind::Plane:
        return p - direction * direction.dot(off);
      case Kind::Point:
        break;
    }
    return point;
  }
};

Datum point_at(const Spot& spot) { return {Datum::Kind::Point, spot.at, Vec3::Zero()}; }

Datum datum_of(const PreparedMesh& prepared, const Spot& spot) {
  const FaceGroup& group = prepared.segmentation.groups[spot.group];
  const Surface& s = group.surface;
  if (spot.is_corner || !group.is_fitted) return point_at(spot);
  if (s.kind == SurfaceKind::Sphere) {
    return {Datum::Kind::Point, s.point, Vec3::Zero(), "centre"};
  }
  const bool is_plane = s.kind == SurfaceKind::Plane;
  Datum datum{is_plane ? Datum::Kind::Plane : Datum::Kind::Axis,
              is_plane ? Vec3(s.axis * s.offset) : s.point, s.axis, is_plane ? "plane" : "axis"};
  datum.point = datum.foot(spot.at);
  return datum;
}

std::string name_of_pair(const Datum& a, const Datum& b) {
  const bool is_same = std::string(a.name) == b.name;
  if (!is_same) return fmt::format("{} to {}", a.name, b.name);
  return a.kind == Datum::Kind::Axis ? "axes" : fmt::format("{}s", a.name);
}

Dimension length(std::string what, const Vec3& from, const Vec3& to) {
  return {std::move(what), (to - from).norm(), false, from, to};
}

/// The points of two axes that are nearest to each other. Requires: they are not parallel.
std::pair<Vec3, Vec3> nearest_points(const Datum& a, const Datum& b) {
  const Vec3 across = a.direction.cross(b.direction);
  const Vec3 off = b.point - a.point;
  const double along = off.cross(b.direction).dot(across) / across.squaredNorm();
  const Vec3 on_a = a.point + a.direction * along;
  return {on_a, b.foot(on_a)};
}

/// Requires: kinds in ascending order.
std::vector<Dimension> between(const Datum& a, const Datum& b) {
  const std::string what = name_of_pair(a, b);
  if (a.is_point()) return {length(what, a.point, b.foot(a.point))};
  double angle_rad = angle_between(a.direction, b.direction);
  angle_rad = std::min(angle_rad, kPi - angle_rad);
  if (a.kind != b.kind) angle_rad = kPi / 2 - angle_rad;  // an axis and a normal
  if (std::abs(angle_rad) < kParallel_rad) return {length(what, a.point, b.foot(a.point))};
  std::vector<Dimension> out = {{what, angle_rad * 180 / kPi, true}};
  if (b.kind == Datum::Kind::Axis) {
    const auto [from, to] = nearest_points(a, b);
    out.push_back(length("closest", from, to));
  }
  return out;
}

void add_parts(std::vector<Dimension>& out, const Vec3& v) {
  for (int k = 0; k < 3; ++k) out.push_back({std::string(1, "xyz"[k]), v[k]});
}

/// Of each vertex, whether triangles of more than one group meet there: few, of a fine mesh.
std::vector<char> vertices_of_several(const PreparedMesh& prepared) {
  const Mesh& mesh = *prepared.mesh;
  std::vector<int> first(mesh.vertices.size(), -1);
  std::vector<char> is_shared(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const int group = prepared.segmentation.group_of_triangle[t];
    if (group < 0) continue;
    for (const int v : mesh.triangles[t]) {
      if (first[v] < 0) first[v] = group;
      if (first[v] != group) is_shared[v] = 1;
    }
  }
  return is_shared;
}

/// Where the ray first meets the group on the side that is seen.
std::optional<Vec3> seen_point(const PreparedMesh& prepared, const Pointing& pointing) {
  constexpr int kMostLayers = 1000;
  const double step = 1e-6 * prepared.mesh->diagonal();
  Vec3 origin = pointing.origin;
  for (int i = 0; i < kMostLayers; ++i) {
    const RayHit hit = prepared.query->cast(origin, pointing.direction);
    if (hit.triangle < 0) return {};
    const Vec3 at = origin + pointing.direction * hit.t;
    const bool is_seen = pointing.cut_normal.dot(at) <= pointing.cut_offset;
    if (is_seen && prepared.segmentation.group_of_triangle[hit.triangle] == pointing.group) {
      return at;
    }
    origin = at + pointing.direction * step;
  }
  return {};
}

}  // namespace

std::vector<Corner> corners_of(const PreparedMesh& prepared) {
  const Mesh& mesh = *prepared.mesh;
  const std::vector<char> is_shared = vertices_of_several(prepared);
  std::vector<std::pair<int, int>> touching;  // vertex, group
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const int group = prepared.segmentation.group_of_triangle[t];
    if (group < 0) continue;
    for (const int v : mesh.triangles[t]) {
      if (is_shared[v]) touching.emplace_back(v, group);
    }
  }
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  std::vector<Corner> corners;
  for (std::size_t i = 0, end = 0; i < touching.size(); i = end) {
    const int vertex = touching[i].first;
    while (end < touching.size() && touching[end].first == vertex) ++end;
    Corner corner{mesh.vertices[vertex], {}};
    for (std::size_t k = i; k < end; ++k) corner.groups.push_back(touching[k].second);
    corners.push_back(std::move(corner));
  }
  return corners;
}

std::optional<Spot> spot_at(const PreparedMesh& prepared, const Pointing& pointing) {
  const auto at = seen_point(prepared, pointing);
  if (!at) return {};
  return Spot{*at, pointing.group, false};
}

std::vector<Dimension> dimensions_of(const PreparedMesh& prepared, const Spot& spot) {
  const FaceGroup& group = prepared.segmentation.groups[spot.group];
  const Surface& s = group.surface;
  std::vector<Dimension> out;
  if (!spot.is_corner && group.is_fitted) {
    if (s.kind == SurfaceKind::Sphere || s.kind == SurfaceKind::Cylinder) {
      out.push_back({"radius", s.radius});
      out.push_back({"diameter", 2 * s.radius});
    } else if (s.kind == SurfaceKind::Cone) {
      out.push_back({"half angle", s.half_angle_rad * 180 / kPi, true});
    } else if (s.kind == SurfaceKind::Torus) {
      out.push_back({"large radius", s.major_radius});
      out.push_back({"small radius", s.radius});
    }
  }
  add_parts(out, spot.at);
  return out;
}

std::vector<Dimension> dimensions_between(const PreparedMesh& prepared, const Spot& a,
                                          const Spot& b) {
  const bool is_one_face = a.group == b.group;
  Datum first = is_one_face ? point_at(a) : datum_of(prepared, a);
  Datum second = is_one_face ? point_at(b) : datum_of(prepared, b);
  const bool are_spots =
      first.is_point() && second.is_point() && first.point == a.at && second.point == b.at;
  const bool is_turned = first.kind > second.kind;
  if (is_turned) std::swap(first, second);
  std::vector<Dimension> out = between(first, second);
  if (is_turned) {
    for (Dimension& dimension : out) std::swap(dimension.from, dimension.to);
  }
  if (!are_spots) out.push_back(length("spots", a.at, b.at));
  add_parts(out, b.at - a.at);
  return out;
}

}  // namespace hewn
