#include <doctest/doctest.h>

#include "core/fit/surface_set.h"
#include "core/segment/segment.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

SurfaceSet regularised(const Mesh& mesh) {
  const RunContext run;
  const Result<Segmentation> s = segment(mesh, {}, run);
  REQUIRE(s.has_value());
  Result<SurfaceSet> set = regularise(mesh, *s, {}, run);
  REQUIRE(set.has_value());
  return std::move(*set);
}

std::vector<Halfspace> of_kind(const SurfaceSet& set, SurfaceKind kind) {
  std::vector<Halfspace> found;
  for (const Halfspace& h : set.halfspaces) {
    if (h.surface.kind == kind) found.push_back(h);
  }
  return found;
}

/// Six decimals, as most files have.
Mesh rounded(const Mesh& mesh) {
  std::vector<Vec3> vertices = mesh.vertices;
  for (Vec3& p : vertices) {
    for (double& c : p) c = std::round(c * 1e5) / 1e5;
  }
  return make_mesh(vertices, mesh.triangles);
}

bool same(const Vec3& a, const Vec3& b) { return (a.array() == b.array()).all(); }

/// What surface_set.h promises of every set.
void check_invariants(const SurfaceSet& set) {
  for (const Halfspace& h : set.halfspaces) {
    CHECK(h.tolerance > 0);
    if (h.surface.kind == SurfaceKind::Sphere) {
      CHECK(h.direction == -1);
      continue;
    }
    REQUIRE(h.direction >= 0);
    const Vec3& d = set.directions[h.direction];
    CHECK((same(h.surface.axis, d) || same(h.surface.axis, -d)));
    CHECK(h.surface.axis.norm() == doctest::Approx(1).epsilon(1e-14));
  }
  for (std::size_t i = 0; i < set.directions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double angle = angle_between(set.directions[i], set.directions[j]);
      CHECK(std::min(angle, kPi - angle) > 1e-4);
      if (std::abs(angle - kPi / 2) < 1e-5) {
        CHECK(std::abs(set.directions[i].dot(set.directions[j])) < 1e-14);
      }
    }
  }
}

TEST_CASE("a part with rounded coordinates gets its round dimensions back") {
  const Mesh mesh = rounded(
      solids::together(solids::cylinder(0.75, 2.5, 60),
                       solids::transformed(solids::plate_with_hole(Vec3(5, 4, 0.5), 1.25, 60),
                                           Affine3(Eigen::Translation3d(10, 2, 0)))));
  const SurfaceSet set = regularised(mesh);
  check_invariants(set);
  const auto cylinders = of_kind(set, SurfaceKind::Cylinder);
  REQUIRE(cylinders.size() == 2);
  for (const Halfspace& h : cylinders) {
    const bool is_boss = h.surface.point.x() == 0;
    CHECK(h.surface.radius == (is_boss ? 0.75 : 1.25));
    CHECK(h.surface.point.x() == (is_boss ? 0.0 : 10.0));
    CHECK(h.surface.point.y() == (is_boss ? 0.0 : 2.0));
    CHECK(same(h.surface.axis, Vec3::UnitZ()));
    CHECK(h.facets.sides == 60);
    // The hole's vertices start at the plate's diagonal, half a step off.
    CHECK(h.facets.phase_rad == doctest::Approx(is_boss ? 0.0 : kPi / 60));
    CHECK(h.mean_offset < 0);
  }
  for (const Halfspace& h : of_kind(set, SurfaceKind::Plane)) {
    CHECK(std::abs(h.surface.offset * 4 - std::round(h.surface.offset * 4)) < 1e-12);
  }
}

TEST_CASE("a cone with rounded coordinates gets its radii or its angle and apex back") {
  struct Design {
    double lower, upper, height;
  };
  // Half angles of 45 degrees; of none that is round; of 30 degrees to a radius that is not round.
  const Design designs[] = {{5.5, 3, 2.5}, {5, 3.2, 2.7}, {4, 4 - 2.5 * std::tan(kPi / 6), 2.5}};
  for (const Design& design : designs) {
    const Mesh mesh = rounded(solids::cone(design.lower, design.upper, design.height, 48));
    const auto cones = of_kind(regularised(mesh), SurfaceKind::Cone);
    REQUIRE(cones.size() == 1);
    const Surface& cone = cones[0].surface;
    const auto radius_at = [&](double z) {
      return (Vec3(0, 0, z) - cone.point).dot(cone.axis) * std::tan(cone.half_angle_rad);
    };
    CHECK(cone.point.head<2>() == Vec2(0, 0));
    CHECK(radius_at(0) == doctest::Approx(design.lower).epsilon(1e-12));
    CHECK(radius_at(design.height) == doctest::Approx(design.upper).epsilon(1e-12));
  }
}

TEST_CASE("a rotated part gets an exactly orthogonal frame of its own") {
  const Mesh mesh = solids::transformed(solids::plate_with_hole(Vec3(5, 4, 0.5), 1.25, 60),
                                        solids::oblique_transform());
  const SurfaceSet set = regularised(mesh);
  check_invariants(set);
  REQUIRE(set.directions.size() == 3);
  CHECK(of_kind(set, SurfaceKind::Plane).size() == 6);
  const auto cylinders = of_kind(set, SurfaceKind::Cylinder);
  REQUIRE(cylinders.size() == 1);
  CHECK(cylinders[0].surface.radius == doctest::Approx(1.25).epsilon(1e-7));
}

TEST_CASE("coaxial cylinders share one axis point to the bit") {
  const Affine3 oblique = solids::oblique_transform();
  const Mesh mesh = solids::transformed(
      solids::revolve({Vec2(0, 0), Vec2(2, 0), Vec2(2, 1), Vec2(1, 1), Vec2(1, 3), Vec2(0, 3)}, 48),
      oblique);
  const SurfaceSet set = regularised(mesh);
  check_invariants(set);
  const auto cylinders = of_kind(set, SurfaceKind::Cylinder);
  REQUIRE(cylinders.size() == 2);
  CHECK(same(cylinders[0].surface.point, cylinders[1].surface.point));
  CHECK(cylinders[0].direction == cylinders[1].direction);
}

TEST_CASE("coplanar faces far apart are one halfspace, near ones beyond the limit two") {
  const Mesh a = solids::box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  const Mesh level = solids::box(Vec3(3, 0, 0), Vec3(4, 1, 1));
  CHECK(regularised(solids::together(a, level)).halfspaces.size() == 8);
  const double step = 0.01;
  const Mesh higher = solids::box(Vec3(3, 0, 0), Vec3(4, 1, 1 + step));
  CHECK(regularised(solids::together(a, higher)).halfspaces.size() == 9);
}

TEST_CASE("no snap moves a surface away from the mesh by more than it may") {
  RegulariseOptions options;
  const RunContext run;
  for (const Mesh& solid :
       {solids::cylinder(0.777777, 2.123457, 60), solids::sphere(1.2345678, 40, 20),
        solids::cone(1.1111111, 0.33333333, 1.7171717, 48)}) {
    const Mesh mesh = solids::transformed(solid, solids::oblique_transform());
    const Result<Segmentation> s = segment(mesh, {}, run);
    REQUIRE(s.has_value());
    const Result<SurfaceSet> set = regularise(mesh, *s, options, run);
    REQUIRE(set.has_value());
    for (std::size_t g = 0; g < s->groups.size(); ++g) {
      const int h = set->halfspace_of_group[g];
      REQUIRE(h >= 0);
      for (const int t : s->groups[g].triangles) {
        for (const int v : mesh.triangles[t]) {
          const double d = set->halfspaces[h].surface.signed_distance(mesh.vertices[v]);
          CHECK(std::abs(d) < 1e-6 * mesh.diagonal());
          CHECK(std::abs(d) <= set->halfspaces[h].tolerance);
        }
      }
    }
  }
}

/// A plane group of the given triangles.
FaceGroup plane_group(const Mesh& mesh, std::vector<int> triangles) {
  FaceGroup group;
  group.surface.axis = mesh.normals[triangles[0]];
  group.surface.offset = group.surface.axis.dot(mesh.corner(triangles[0], 0));
  for (const int t : triangles) group.area += mesh.areas[t];
  group.triangles = std::move(triangles);
  return group;
}

TEST_CASE("a wedge thinner than any wall is closed, a thicker one kept") {
  for (const double drop : {1e-4, 1e-3}) {
    CAPTURE(drop);
    // A square and a narrow strip along its side that turns down a little.
    const std::vector<Vec3> vertices = {{0, 0, 0}, {0.9, 0, 0},   {0.9, 1, 0},
                                        {0, 1, 0}, {1, 0, -drop}, {1, 1, -drop}};
    const Mesh mesh = make_mesh(vertices, {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}});
    Segmentation s;
    s.groups = {plane_group(mesh, {0, 1}), plane_group(mesh, {2, 3})};
    s.group_of_triangle = {0, 0, 1, 1};
    const RunContext run;
    const Result<SurfaceSet> set = regularise(mesh, s, {}, run);
    REQUIRE(set.has_value());
    check_invariants(*set);
    const std::size_t expected = drop < 1.5e-4 * mesh.diagonal() ? 1 : 2;
    CHECK(set->halfspaces.size() == expected);
    CHECK(set->directions.size() == expected);
    CHECK(same(set->halfspaces[0].surface.axis, Vec3::UnitZ()));
    CHECK(set->halfspace_of_group[1] == static_cast<int>(expected) - 1);
  }
}

TEST_CASE("planes of a free-form patch count as unexplained") {
  const Mesh mesh = solids::box(Vec3::Zero(), Vec3::Ones());
  const RunContext run;
  Result<Segmentation> s = segment(mesh, {}, run);
  REQUIRE(s.has_value());
  Result<SurfaceSet> set = regularise(mesh, *s, {}, run);
  REQUIRE(set.has_value());
  CHECK(set->unexplained_area < 1e-12);
  s->groups[0].is_fitted = false;
  set = regularise(mesh, *s, {}, run);
  REQUIRE(set.has_value());
  CHECK(set->unexplained_area == doctest::Approx(1.0 / 6));
}

TEST_CASE("faces at 27 degrees keep a round angle") {
  const double degree = kPi / 180;
  const Affine3 turn(Eigen::AngleAxisd(27 * degree, Vec3::UnitZ()));
  const Mesh mesh = rounded(
      solids::together(solids::box(Vec3(-3, -3, 0), Vec3(3, 3, 1)),
                       solids::transformed(solids::box(Vec3(5, -1, 0), Vec3(7, 1, 2)), turn)));
  const SurfaceSet set = regularised(mesh);
  check_invariants(set);
  bool found = false;
  for (const Vec3& d : set.directions) {
    found = found || std::abs(std::atan2(d.y(), d.x()) - 27 * degree) < 1e-15;
  }
  CHECK(found);
}

}  // namespace
}  // namespace hewn
