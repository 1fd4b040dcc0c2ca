/// Cylinders and cones between capping planes, spheres, tori, and compounds for fillets.
#include <algorithm>

#include "core/fit/bounded_parts.h"

namespace hewn {
namespace {

/// A group that covers more of the circle than this is no fillet.
constexpr double kMaxFilletSpanRad = kPi * 0.95;

bool has_flank(const Surface& s) {
  return s.kind == SurfaceKind::Cylinder || s.kind == SurfaceKind::Cone;
}

double radius_at(const Surface& s, double height) {
  if (s.kind == SurfaceKind::Cylinder) return s.radius;
  return std::max(0.0, height * std::tan(s.half_angle_rad));
}

/// The cylinder or frustum between two heights along the surface's axis, measured from its point.
Literal flank_solid(const Surface& s, const Interval& heights) {
  Literal solid;
  solid.kind = SolidKind::Cylinder;
  solid.rotation = rotation_about(s.axis);
  const bool is_flipped = solid.rotation.col(2).dot(s.axis) < 0;
  const double base = is_flipped ? -heights.hi : heights.lo;
  solid.origin = solid.rotation.transpose() * s.point + Vec3(0, 0, base);
  solid.height = heights.length();
  solid.radius = radius_at(s, is_flipped ? heights.hi : heights.lo);
  solid.top_radius = radius_at(s, is_flipped ? heights.lo : heights.hi);
  return solid;
}

/// The extent of triangles along the axis from the surface's point, its ends moved onto planes.
Interval capped_extent(const BoundedInput& input, const Surface& s, std::span<const int> triangles,
                       std::vector<int>& caps) {
  const double base = s.axis.dot(s.point);
  const std::vector<ParallelPlane> planes = planes_across(input, s.axis);
  Interval heights = extent_along(input.mesh, triangles, s.axis);
  for (double* end : {&heights.lo, &heights.hi}) {
    const ParallelPlane* cap = plane_at(planes, *end, input.snap);
    if (cap) caps.push_back(cap->halfspace);
    *end = (cap ? cap->height : *end) - base;
  }
  if (s.kind == SurfaceKind::Cone) heights.lo = std::max(0.0, heights.lo);
  return heights;
}

void sort_unique(std::vector<int>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

void add_flank(const BoundedInput& input, int halfspace, std::vector<int> groups,
               std::vector<BoundedPrimitive>& out) {
  const Surface& s = input.surfaces.halfspaces[halfspace].surface;
  std::vector<int> triangles;
  for (const int g : groups) {
    const auto& more = input.segmentation.groups[g].triangles;
    triangles.insert(triangles.end(), more.begin(), more.end());
  }
  BoundedPrimitive primitive;
  primitive.kind = s.kind == SurfaceKind::Cone ? BoundedKind::Cone : BoundedKind::Cylinder;
  primitive.halfspaces = {halfspace};
  const Interval heights = capped_extent(input, s, triangles, primitive.halfspaces);
  if (!(heights.length() > 0)) return;
  primitive.literal = flank_solid(s, heights);
  primitive.literal.facets = input.surfaces.halfspaces[halfspace].facets;
  primitive.groups = std::move(groups);
  sort_unique(primitive.halfspaces);
  out.push_back(std::move(primitive));
}

void add_ball_or_ring(const BoundedInput& input, int halfspace, std::vector<int> groups,
                      std::vector<BoundedPrimitive>& out) {
  const Surface& s = input.surfaces.halfspaces[halfspace].surface;
  const bool is_ball = s.kind == SurfaceKind::Sphere;
  BoundedPrimitive primitive;
  primitive.kind = is_ball ? BoundedKind::Sphere : BoundedKind::Torus;
  primitive.literal.kind = is_ball ? SolidKind::Sphere : SolidKind::Torus;
  if (!is_ball) primitive.literal.rotation = rotation_about(s.axis);
  primitive.literal.origin = primitive.literal.rotation.transpose() * s.point;
  primitive.literal.radius = s.radius;
  primitive.literal.major_radius = is_ball ? 0 : s.major_radius;
  primitive.literal.facets = input.surfaces.halfspaces[halfspace].facets;
  primitive.groups = std::move(groups);
  primitive.halfspaces = {halfspace};
  out.push_back(std::move(primitive));
}

/// The part of the circle that a group covers: `middle` points to its centre from the axis.
struct Arc {
  Vec3 middle = Vec3::Zero();
  double half_span_rad = 0;
};

Arc arc_of(const Mesh& mesh, const FaceGroup& group, const Surface& s) {
  Arc arc;
  for (const int t : group.triangles) {
    const Vec3 d = mesh.centroid(t) - s.point;
    const Vec3 across = d - s.axis * s.axis.dot(d);
    if (across.norm() > 0) arc.middle += across.normalized() * mesh.areas[t];
  }
  if (!(arc.middle.norm() > 1e-9 * group.area)) return {Vec3::Zero(), kPi};
  arc.middle.normalize();
  for (const int t : group.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 d = mesh.corner(t, k) - s.point;
      const Vec3 across = d - s.axis * s.axis.dot(d);
      if (across.norm() > 0) {
        arc.half_span_rad =
            std::max(arc.half_span_rad, angle_between(across.normalized(), arc.middle));
      }
    }
  }
  return arc;
}

}  // namespace

void add_round_solids(const BoundedInput& input, std::vector<BoundedPrimitive>& out) {
  for (int h = 0; h < static_cast<int>(input.surfaces.halfspaces.size()); ++h) {
    const Surface& s = input.surfaces.halfspaces[h].surface;
    if (s.kind == SurfaceKind::Plane) continue;
    const std::vector<int> groups = groups_on(input.surfaces, h);
    if (groups.empty()) continue;
    if (!has_flank(s)) {
      add_ball_or_ring(input, h, groups, out);
      continue;
    }
    // Coaxial equal surfaces may be one solid that others interrupt, or one for each group.
    add_flank(input, h, groups, out);
    for (const int g : groups) {
      if (groups.size() > 1) add_flank(input, h, {g}, out);
    }
  }
}

void add_fillets(const BoundedInput& input, std::vector<BoundedPrimitive>& out) {
  for (int g = 0; g < static_cast<int>(input.segmentation.groups.size()); ++g) {
    const int h = input.surfaces.halfspace_of_group[g];
    if (h < 0 || !has_flank(input.surfaces.halfspaces[h].surface)) continue;
    const Surface& s = input.surfaces.halfspaces[h].surface;
    const FaceGroup& group = input.segmentation.groups[g];
    const Arc arc = arc_of(input.mesh, group, s);
    if (2 * arc.half_span_rad >= kMaxFilletSpanRad) continue;
    BoundedPrimitive primitive;
    primitive.kind = BoundedKind::Fillet;
    primitive.halfspaces = {h};
    const Interval heights = capped_extent(input, s, group.triangles, primitive.halfspaces);
    if (!(heights.length() > 0)) continue;
    // From the chord to where the tangent planes at both rims meet.
    const double widest = std::max(radius_at(s, heights.lo), radius_at(s, heights.hi));
    const double narrowest = std::min(radius_at(s, heights.lo), radius_at(s, heights.hi));
    const double chord = narrowest * std::cos(arc.half_span_rad);
    const double tip = widest / std::cos(arc.half_span_rad);
    const double half_width = widest * std::sin(arc.half_span_rad);
    const Vec3 side = s.axis.cross(arc.middle);
    const Vec3 near = s.point + s.axis * heights.lo + arc.middle * chord - side * half_width;
    const Vec3 far = s.point + s.axis * heights.hi + arc.middle * tip + side * half_width;
    Literal& box = primitive.literal;
    box.rotation = rotation_of(s.axis, arc.middle, side);
    const Vec3 a = box.rotation.transpose() * near;
    const Vec3 b = box.rotation.transpose() * far;
    box.origin = a.cwiseMin(b);
    box.size = (a - b).cwiseAbs();
    // The tool sticks out of the box, so that no sheet of no thickness is left on its ends.
    const double margin = 0.1 * heights.length();
    Interval longer{heights.lo - margin, heights.hi + margin};
    if (s.kind == SurfaceKind::Cone) longer.lo = std::max(0.0, longer.lo);
    primitive.minus = flank_solid(s, longer);
    primitive.groups = {g};
    sort_unique(primitive.halfspaces);
    out.push_back(std::move(primitive));
  }
}

}  // namespace hewn
