#include "tests/support/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace hewn::solids {
namespace {

/// Collects triangles and joins vertices with equal coordinates.
class Builder {
 public:
  int vertex(const Vec3& p) {
    // Adding zero turns -0 into +0, so that both compare equal as keys.
    const std::array<double, 3> key{p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
    const auto [it, is_new] = index_.try_emplace(key, static_cast<int>(vertices_.size()));
    if (is_new) vertices_.push_back(p);
    return it->second;
  }
  void triangle(int a, int b, int c) {
    if (a != b && b != c && c != a) triangles_.push_back({a, b, c});
  }
  void quad(int a, int b, int c, int d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  Mesh finish() { return make_mesh(std::move(vertices_), std::move(triangles_)); }

 private:
  std::map<std::array<double, 3>, int> index_;
  std::vector<Vec3> vertices_;
  std::vector<Triangle> triangles_;
};

Vec3 on_circle(double radius, double z, int step, int sides) {
  const double angle = 2 * kPi * (step % sides) / sides;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Points from the start to the end of a segment, the start included, the end not.
void append_steps(std::vector<Vec2>& out, const Vec2& from, const Vec2& to, int steps) {
  for (int i = 0; i < steps; ++i) out.push_back(from + (to - from) * (double(i) / steps));
}

/// Fans and bands between outlines at two heights: the flank of a prism, outwards.
void add_walls(Builder& builder, const std::vector<Vec2>& outline, double z0, double z1) {
  const auto at = [&](std::size_t i, double z) {
    const Vec2& p = outline[i % outline.size()];
    return builder.vertex({p.x(), p.y(), z});
  };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    builder.quad(at(i, z0), at(i + 1, z0), at(i + 1, z1), at(i, z1));
  }
}

}  // namespace

Mesh box(const Vec3& lo, const Vec3& hi, int cells) {
  Builder builder;
  const auto coordinate = [&](int axis, int i) {
    return i == cells ? hi[axis] : lo[axis] + (hi[axis] - lo[axis]) * i / cells;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const bool is_top : {false, true}) {
      const auto at = [&](int i, int j) {
        Vec3 p;
        p[axis] = is_top ? hi[axis] : lo[axis];
        p[u] = coordinate(u, i);
        p[v] = coordinate(v, j);
        return builder.vertex(p);
      };
      for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
          const std::array<int, 4> q{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
          is_top ? builder.quad(q[0], q[1], q[2], q[3]) : builder.quad(q[3], q[2], q[1], q[0]);
        }
      }
    }
  }
  return builder.finish();
}

Mesh revolve(const std::vector<Vec2>& profile, int sides, bool is_closed) {
  Builder builder;
  const std::size_t n = profile.size();
  const std::size_t segments = is_closed ? n : n - 1;
  for (std::size_t k = 0; k < segments; ++k) {
    const Vec2& p = profile[k];
    const Vec2& q = profile[(k + 1) % n];
    for (int i = 0; i < sides; ++i) {
      const int p0 = builder.vertex(on_circle(p.x(), p.y(), i, sides));
      const int p1 = builder.vertex(on_circle(p.x(), p.y(), i + 1, sides));
      const int q0 = builder.vertex(on_circle(q.x(), q.y(), i, sides));
      const int q1 = builder.vertex(on_circle(q.x(), q.y(), i + 1, sides));
      builder.quad(p0, p1, q1, q0);
    }
  }
  return builder.finish();
}

Mesh cylinder(double radius, double height, int sides, int rings) {
  return cone(radius, radius, height, sides, rings);
}

Mesh cone(double radius, double top_radius, double height, int sides, int rings) {
  std::vector<Vec2> profile;
  profile.push_back({0, 0});
  append_steps(profile, {radius, 0}, {top_radius, height}, rings);
  if (top_radius > 0) profile.push_back({top_radius, height});
  profile.push_back({0, height});
  return revolve(profile, sides);
}

Mesh sphere(double radius, int sides, int rings) {
  std::vector<Vec2> profile;
  profile.push_back({0, -radius});
  for (int i = 1; i < rings; ++i) {
    const double angle = kPi * i / rings - kPi / 2;
    profile.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  profile.push_back({0, radius});
  return revolve(profile, sides);
}

Mesh torus(double major_radius, double radius, int sides, int tube_sides) {
  std::vector<Vec2> profile;
  for (int i = 0; i < tube_sides; ++i) {
    const double angle = 2 * kPi * i / tube_sides;
    profile.push_back({major_radius + radius * std::cos(angle), radius * std::sin(angle)});
  }
  return revolve(profile, sides, true);
}

Mesh capsule(double radius, double height, int sides, int rings) {
  std::vector<Vec2> profile;
  profile.push_back({0, -radius});
  for (int i = 1; i <= rings; ++i) {
    const double angle = kPi / 2 * i / rings;
    profile.push_back({radius * std::sin(angle), -radius * std::cos(angle)});
  }
  for (int i = 0; i < rings; ++i) {
    const double angle = kPi / 2 * i / rings;
    profile.push_back({radius * std::cos(angle), height + radius * std::sin(angle)});
  }
  profile.push_back({0, height + radius});
  return revolve(profile, sides);
}

Mesh plate_with_hole(const Vec3& size, double hole_radius, int sides, int rings) {
  const Vec2 half(size.x() / 2, size.y() / 2);
  std::vector<Vec2> outer;
  append_steps(outer, -half, {half.x(), -half.y()}, sides / 4);
  append_steps(outer, {half.x(), -half.y()}, half, sides / 4);
  append_steps(outer, half, {-half.x(), half.y()}, sides / 4);
  append_steps(outer, {-half.x(), half.y()}, -half, sides / 4);
  std::vector<Vec2> hole;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides - 0.75 * kPi;
    hole.push_back(hole_radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  const double z0 = -size.z() / 2;
  const double z1 = size.z() / 2;
  Builder builder;
  add_walls(builder, outer, z0, z1);
  const std::vector<Vec2> inward(hole.rbegin(), hole.rend());
  for (int k = 0; k < rings; ++k) {
    const double a = z0 + (z1 - z0) * k / rings;
    const double b = k + 1 == rings ? z1 : z0 + (z1 - z0) * (k + 1) / rings;
    add_walls(builder, inward, a, b);
  }
  for (const double z : {z0, z1}) {
    for (int i = 0; i < sides; ++i) {
      const auto at = [&](const std::vector<Vec2>& loop, int k) {
        const Vec2& p = loop[k % sides];
        return builder.vertex({p.x(), p.y(), z});
      };
      const std::array<int, 4> q{at(outer, i), at(outer, i + 1), at(hole, i + 1), at(hole, i)};
      z > 0 ? builder.quad(q[0], q[1], q[2], q[3]) : builder.quad(q[3], q[2], q[1], q[0]);
    }
  }
  return builder.finish();
}

Mesh block_with_fillet(const Vec3& size, double radius, int steps) {
  std::vector<Vec2> outline{{0, 0}, {size.x(), 0}};
  for (int i = 0; i <= steps; ++i) {
    const double angle = kPi / 2 * i / steps;
    outline.push_back({size.x() - radius + radius * std::cos(angle),
                       size.y() - radius + radius * std::sin(angle)});
  }
  outline.push_back({0, size.y()});
  Builder builder;
  add_walls(builder, outline, 0, size.z());
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    const auto at = [&](std::size_t k, double z) {
      return builder.vertex({outline[k].x(), outline[k].y(), z});
    };
    builder.triangle(at(0, size.z()), at(i, size.z()), at(i + 1, size.z()));
    builder.triangle(at(0, 0), at(i + 1, 0), at(i, 0));
  }
  return builder.finish();
}

Mesh transformed(const Mesh& mesh, const Affine3& transform) {
  std::vector<Vec3> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) vertices.push_back(transform * p);
  return make_mesh(std::move(vertices), mesh.triangles);
}

Mesh together(const Mesh& a, const Mesh& b) {
  std::vector<Vec3> vertices = a.vertices;
  vertices.insert(vertices.end(), b.vertices.begin(), b.vertices.end());
  std::vector<Triangle> triangles = a.triangles;
  const int shift = static_cast<int>(a.vertices.size());
  for (const auto& [p, q, r] : b.triangles) triangles.push_back({p + shift, q + shift, r + shift});
  return make_mesh(std::move(vertices), std::move(triangles));
}

bool is_closed(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> uses;
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  }
  return std::all_of(uses.begin(), uses.end(), [&](const auto& use) {
    const auto opposite = uses.find({use.first.second, use.first.first});
    return use.second == 1 && opposite != uses.end() && opposite->second == 1;
  });
}

Affine3 oblique_transform() {
  const Eigen::AngleAxisd turn(0.7, Vec3(0.3, -0.5, 0.8).normalized());
  return Eigen::Translation3d(0.4, -1.3, 2.1) * turn;
}

}  // namespace hewn::solids
