#include "core/fit/bounded.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "tests/core/segment/edit/known_groups.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

using Primitives = std::vector<BoundedPrimitive>;

Primitives build(const Mesh& mesh, const std::vector<Surface>& surfaces,
                 const BoundedOptions& options = {}) {
  const Segmentation segmentation = segment_by_surfaces(mesh, surfaces);
  const auto set = regularise(mesh, segmentation, {}, {});
  REQUIRE(set.has_value());
  auto primitives = build_bounded_primitives(mesh, segmentation, *set, options, {});
  REQUIRE(primitives.has_value());
  return std::move(*primitives);
}

Primitives of_kind(const Primitives& all, BoundedKind kind) {
  Primitives found;
  std::copy_if(all.begin(), all.end(), std::back_inserter(found),
               [&](const BoundedPrimitive& p) { return p.kind == kind; });
  return found;
}

Surface turned(Surface s, const Affine3& move) {
  s.point = move * s.point;
  s.axis = move.rotation() * s.axis;
  s.offset += s.axis.dot(move.translation());
  return s;
}

std::vector<Surface> turned(std::vector<Surface> surfaces, const Affine3& move) {
  for (Surface& s : surfaces) s = turned(s, move);
  return surfaces;
}

/// The largest distance of the mesh's vertices from the primitive's surface.
double max_distance(const BoundedPrimitive& primitive, const Mesh& mesh) {
  double largest = 0;
  for (const Vec3& p : mesh.vertices) {
    largest = std::max(largest, std::abs(primitive.signed_distance(p)));
  }
  return largest;
}

TEST_CASE("a box is one cuboid, however it is turned") {
  const Vec3 hi(1, 2, 3);
  const auto straight =
      of_kind(build(solids::box({0, 0, 0}, hi), box_sides({0, 0, 0}, hi)), BoundedKind::Cuboid);
  REQUIRE(straight.size() == 1);
  CHECK(straight[0].literal.rotation == Mat3::Identity());
  CHECK(straight[0].literal.origin == Vec3::Zero());
  CHECK(straight[0].literal.size == hi);
  CHECK(straight[0].groups == std::vector<int>{0, 1, 2, 3, 4, 5});
  CHECK(straight[0].halfspaces.size() == 6);

  const Affine3 move = solids::oblique_transform();
  const Mesh mesh = solids::transformed(solids::box({0, 0, 0}, hi), move);
  const auto oblique =
      of_kind(build(mesh, turned(box_sides({0, 0, 0}, hi), move)), BoundedKind::Cuboid);
  REQUIRE(oblique.size() == 1);
  CHECK(max_distance(oblique[0], mesh) < 1e-6);
  CHECK(oblique[0].literal.size.prod() == doctest::Approx(6).epsilon(1e-6));
}

TEST_CASE("cylinders and cones end at their caps") {
  const Affine3 move = solids::oblique_transform();
  const std::vector<Surface> caps{plane(-Vec3::UnitZ(), 0), plane(Vec3::UnitZ(), 3)};
  std::vector<Surface> rod_surfaces = caps;
  rod_surfaces.push_back(cylinder_surface(Vec3::Zero(), Vec3::UnitZ(), 1.5));
  const Mesh rod = solids::transformed(solids::cylinder(1.5, 3, 48), move);
  const auto cylinders = of_kind(build(rod, turned(rod_surfaces, move)), BoundedKind::Cylinder);
  REQUIRE(cylinders.size() == 1);
  CHECK(cylinders[0].literal.height == doctest::Approx(3));
  CHECK(cylinders[0].literal.radius == doctest::Approx(1.5));
  CHECK(cylinders[0].halfspaces.size() == 3);
  for (const Vec3& p : rod.vertices) {
    CHECK(cylinders[0].signed_distance(p) < 1e-6);
  }

  Surface flank;
  flank.kind = SurfaceKind::Cone;
  flank.point = Vec3(0, 0, 6);
  flank.axis = -Vec3::UnitZ();
  flank.half_angle_rad = std::atan2(1, 3);
  std::vector<Surface> plug_surfaces = caps;
  plug_surfaces.push_back(flank);
  const Mesh plug = solids::transformed(solids::cone(2, 1, 3, 48), move);
  const auto cones = of_kind(build(plug, turned(plug_surfaces, move)), BoundedKind::Cone);
  REQUIRE(cones.size() == 1);
  const Literal& cone = cones[0].literal;
  CHECK(cone.height == doctest::Approx(3));
  CHECK(std::max(cone.radius, cone.top_radius) == doctest::Approx(2));
  CHECK(std::min(cone.radius, cone.top_radius) == doctest::Approx(1));
  for (const Vec3& p : plug.vertices) {
    CHECK(cones[0].signed_distance(p) < 1e-6);
  }
}

TEST_CASE("a plate with a hole is a cuboid and a cylinder through it") {
  std::vector<Surface> surfaces = box_sides({-2, -1.5, -0.5}, {2, 1.5, 0.5});
  surfaces.push_back(cylinder_surface(Vec3::Zero(), Vec3::UnitZ(), 0.8));
  const Mesh mesh = solids::plate_with_hole({4, 3, 1}, 0.8, 48);
  const Primitives all = build(mesh, surfaces);
  const auto cuboids = of_kind(all, BoundedKind::Cuboid);
  const auto cylinders = of_kind(all, BoundedKind::Cylinder);
  REQUIRE(cuboids.size() == 1);
  REQUIRE(cylinders.size() == 1);
  CHECK((cuboids[0].literal.size - Vec3(4, 3, 1)).norm() < 1e-9);
  CHECK(cylinders[0].literal.height == doctest::Approx(1));
  CHECK(of_kind(all, BoundedKind::Fillet).empty());
  Rng rng(2);
  for (int i = 0; i < 200; ++i) {
    Vec3 x;
    for (double& c : x) c = rng.uniform(-2.2, 2.2);
    const bool is_in = cuboids[0].signed_distance(x) < 0 && cylinders[0].signed_distance(x) > 0;
    const bool is_in_part = std::abs(x.x()) < 2 && std::abs(x.y()) < 1.5 && std::abs(x.z()) < 0.5 &&
                            x.head<2>().norm() > 0.8;
    CHECK(is_in == is_in_part);
  }
}

TEST_CASE("spheres and tori stand as they are") {
  Surface ball;
  ball.kind = SurfaceKind::Sphere;
  ball.point = Vec3(1, 2, 3);
  ball.radius = 2;
  const Mesh sphere =
      solids::transformed(solids::sphere(2, 32, 16), Affine3(Eigen::Translation3d(1, 2, 3)));
  const auto spheres = of_kind(build(sphere, {ball}), BoundedKind::Sphere);
  REQUIRE(spheres.size() == 1);
  CHECK(max_distance(spheres[0], sphere) < 1e-6);

  Surface ring;
  ring.kind = SurfaceKind::Torus;
  ring.major_radius = 3;
  ring.radius = 1;
  const Mesh torus = solids::torus(3, 1, 48, 24);
  const auto tori = of_kind(build(torus, {ring}), BoundedKind::Torus);
  REQUIRE(tori.size() == 1);
  CHECK(max_distance(tori[0], torus) < 1e-6);
}

TEST_CASE("a fillet is the block minus its compound") {
  const Vec3 size(4, 3, 2);
  const double r = 0.8;
  std::vector<Surface> surfaces = box_sides({0, 0, 0}, size);
  surfaces.push_back(cylinder_surface({size.x() - r, size.y() - r, 0}, Vec3::UnitZ(), r));
  const Primitives all = build(solids::block_with_fillet(size, r, 16), surfaces);
  const auto cuboids = of_kind(all, BoundedKind::Cuboid);
  const auto fillets = of_kind(all, BoundedKind::Fillet);
  REQUIRE(fillets.size() == 1);
  REQUIRE(fillets[0].minus.has_value());
  const auto block = std::find_if(cuboids.begin(), cuboids.end(), [&](const auto& c) {
    return (c.literal.size - size).norm() < 1e-9;
  });
  REQUIRE(block != cuboids.end());
  Rng rng(4);
  for (int i = 0; i < 2000; ++i) {
    Vec3 x;
    for (int k = 0; k < 3; ++k) x[k] = rng.uniform(0, size[k]);
    const Vec2 d = x.head<2>() - Vec2(size.x() - r, size.y() - r);
    const bool is_cut = d.minCoeff() > 0 && d.norm() > r;
    CHECK((fillets[0].signed_distance(x) < 0) == is_cut);
  }
}

TEST_CASE("extra planes bound curved groups, and can be left out") {
  Surface ball;
  ball.kind = SurfaceKind::Sphere;
  ball.radius = 1;
  // The upper cap of a capsule: a half sphere on a cylinder.
  std::vector<Surface> surfaces{ball, cylinder_surface(Vec3::Zero(), Vec3::UnitZ(), 1)};
  surfaces[0].point = Vec3(0, 0, 4);
  Surface bottom = ball;
  surfaces.push_back(bottom);
  const Mesh mesh = solids::capsule(1, 4, 48, 12);
  const Primitives with = build(mesh, surfaces);
  const auto planes = of_kind(with, BoundedKind::ExtraPlane);
  CHECK(planes.size() >= 6);
  for (const BoundedPrimitive& p : planes) {
    CHECK(p.literal.kind == SolidKind::Box);
    CHECK_FALSE(p.groups.empty());
  }
  BoundedOptions options;
  options.extra_planes = false;
  CHECK(of_kind(build(mesh, surfaces, options), BoundedKind::ExtraPlane).empty());
}

TEST_CASE("no two primitives are the same, and runs agree") {
  std::vector<Surface> surfaces = box_sides({-2, -1.5, -0.5}, {2, 1.5, 0.5});
  surfaces.push_back(cylinder_surface(Vec3::Zero(), Vec3::UnitZ(), 0.8));
  const Mesh mesh = solids::plate_with_hole({4, 3, 1}, 0.8, 48);
  const Primitives first = build(mesh, surfaces);
  const Primitives second = build(mesh, surfaces);
  REQUIRE(first.size() == second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first[i].literal.origin == second[i].literal.origin);
    for (std::size_t j = 0; j < i; ++j) {
      const Literal& a = first[i].literal;
      const Literal& b = first[j].literal;
      const bool is_same = a.kind == b.kind && (a.rotation - b.rotation).norm() < 1e-9 &&
                           (a.origin - b.origin).norm() < 1e-9 && (a.size - b.size).norm() < 1e-9 &&
                           a.height == b.height && a.radius == b.radius;
      CHECK_FALSE((is_same && !first[i].minus && !first[j].minus));
    }
  }
}

}  // namespace
}  // namespace hewn
