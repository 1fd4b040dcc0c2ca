#include "core/synth/rebuild/tree_surfaces.h"

#include <algorithm>
#include <cmath>

#include "core/csg/prism.h"

namespace hewn {
namespace {

constexpr double kSame = 1e-9;

class Collector {
 public:
  explicit Collector(double scale) : tolerance_(kSame * scale) {}

  bool add(const Literal& s) {
    const bool is_known = s.kind == SolidKind::Box || s.kind == SolidKind::Cylinder ||
                          s.kind == SolidKind::Sphere || s.kind == SolidKind::Torus ||
                          s.kind == SolidKind::Prism;
    if (s.stretch || !is_known) return false;
    out_.of_literal.emplace_back();
    if (s.kind == SolidKind::Box) add_box(s);
    if (s.kind == SolidKind::Cylinder) add_tube(s);
    if (s.kind == SolidKind::Prism) add_prism(s);
    if (s.kind == SolidKind::Sphere || s.kind == SolidKind::Torus) add_ball_or_torus(s);
    return true;
  }

  TreeSurfaces take() { return std::move(out_); }

 private:
  /// The known direction that is parallel, else a new one; the largest component is positive.
  int direction(Vec3 axis) {
    int largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    if (axis[largest] < 0) axis = -axis;
    if (axis[largest] > 1 - 1e-12) axis = Vec3::Unit(largest);
    auto& known = out_.all.directions;
    for (std::size_t k = 0; k < known.size(); ++k) {
      if (known[k].cross(axis).norm() < kSame) return static_cast<int>(k);
    }
    known.push_back(axis);
    return static_cast<int>(known.size()) - 1;
  }

  void add_box(const Literal& s) {
    for (int k = 0; k < 3; ++k) {
      add_plane(s.rotation.col(k), s.origin[k]);
      add_plane(s.rotation.col(k), s.origin[k] + s.size[k]);
    }
  }

  void add_plane(const Vec3& normal, double offset) {
    Surface plane;
    const int d = direction(normal);
    plane.axis = out_.all.directions[static_cast<std::size_t>(d)];
    plane.offset = plane.axis.dot(normal) < 0 ? -offset : offset;
    keep(plane, d);
  }

  void add_prism(const Literal& s) {
    add_ends(s);
    for (int k = 0; k < s.sides; ++k) {
      const Vec2 flat = prism_side_normal(s, k);
      const Vec2 corner = prism_corner(s, k);
      const Vec3 normal = s.rotation * Vec3(flat.x(), flat.y(), 0);
      add_plane(normal, normal.dot(s.to_world(Vec3(corner.x(), corner.y(), 0))));
    }
  }

  void add_ends(const Literal& s) {
    add_plane(s.rotation.col(2), s.origin.z());
    add_plane(s.rotation.col(2), s.origin.z() + s.height);
  }

  void add_tube(const Literal& s) {
    const Vec3 up = s.rotation.col(2);
    add_ends(s);
    const int d = direction(up);
    const Vec3 axis = out_.all.directions[static_cast<std::size_t>(d)];
    Surface flank;
    flank.axis = axis;
    if (s.radius == s.top_radius) {
      flank.kind = SurfaceKind::Cylinder;
      flank.radius = s.radius;
      const Vec3 foot = s.rotation * s.origin;
      flank.point = foot - axis.dot(foot) * axis;
    } else {
      flank.kind = SurfaceKind::Cone;
      const double slope = (s.top_radius - s.radius) / s.height;
      flank.point = s.to_world(Vec3(0, 0, -s.radius / slope));
      flank.axis = (up.dot(axis) > 0) == (slope > 0) ? axis : Vec3(-axis);
      flank.half_angle_rad = std::atan(std::abs(slope));
    }
    keep(flank, d);
  }

  void add_ball_or_torus(const Literal& s) {
    Surface surface;
    surface.kind = s.kind == SolidKind::Sphere ? SurfaceKind::Sphere : SurfaceKind::Torus;
    surface.point = s.to_world(Vec3::Zero());
    surface.radius = s.radius;
    surface.major_radius = s.major_radius;
    const int d = s.kind == SolidKind::Sphere ? -1 : direction(s.rotation.col(2));
    if (d >= 0) surface.axis = out_.all.directions[static_cast<std::size_t>(d)];
    keep(surface, d);
  }

  bool is_same(const Surface& a, const Surface& b) const {
    return a.kind == b.kind && std::abs(a.offset - b.offset) < tolerance_ &&
           (a.point - b.point).norm() < tolerance_ && std::abs(a.radius - b.radius) < tolerance_ &&
           std::abs(a.major_radius - b.major_radius) < tolerance_ &&
           (a.axis - b.axis).norm() < kSame &&
           std::abs(a.half_angle_rad - b.half_angle_rad) < kSame;
  }

  void keep(const Surface& surface, int direction) {
    auto& known = out_.all.halfspaces;
    std::size_t k = 0;
    while (k < known.size() && !is_same(known[k].surface, surface)) ++k;
    if (k == known.size()) {
      Halfspace h;
      h.surface = surface;
      h.direction = direction;
      known.push_back(h);
    }
    out_.of_literal.back().push_back(static_cast<int>(k));
  }

  double tolerance_;
  TreeSurfaces out_;
};

}  // namespace

int TreeSurfaces::nearest(int literal, const Vec3& p) const {
  int best = -1;
  double least = kInfinity;
  for (const int h : of_literal[static_cast<std::size_t>(literal)]) {
    const double d =
        std::abs(all.halfspaces[static_cast<std::size_t>(h)].surface.signed_distance(p));
    if (d >= least) continue;
    least = d;
    best = h;
  }
  return best;
}

std::optional<TreeSurfaces> surfaces_of(const std::vector<Literal>& literals, double scale) {
  Collector collector(scale);
  for (const Literal& s : literals) {
    if (!collector.add(s)) return std::nullopt;
  }
  return collector.take();
}

}  // namespace hewn
