#include "core/segment/facet_method.h"

#include <algorithm>
#include <memory>

#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "core/mesh/load.h"
#include "core/segment/segment.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

Segmentation segmented(const Mesh& mesh) {
  const RunContext run;
  Result<Segmentation> result = segment(mesh, {}, run);
  REQUIRE(result.has_value());
  return std::move(*result);
}

std::vector<FaceGroup> groups_of_kind(const Segmentation& s, SurfaceKind kind) {
  std::vector<FaceGroup> found;
  for (const FaceGroup& g : s.groups) {
    if (g.surface.kind == kind) found.push_back(g);
  }
  return found;
}

Mesh jittered(const Mesh& mesh, double amount, int seed = 11) {
  Rng rng(static_cast<std::uint64_t>(seed));
  std::vector<Vec3> vertices = mesh.vertices;
  for (Vec3& p : vertices) {
    for (double& c : p) c += rng.uniform(-amount, amount);
  }
  return make_mesh(vertices, mesh.triangles);
}

/// Every triangle lies in exactly one group, and the groups' values are consistent.
void check_partition(const Mesh& mesh, const Segmentation& s) {
  std::vector<int> owner(mesh.triangles.size(), -1);
  double area = 0;
  for (std::size_t g = 0; g < s.groups.size(); ++g) {
    CHECK(std::is_sorted(s.groups[g].triangles.begin(), s.groups[g].triangles.end()));
    area += s.groups[g].area;
    for (const int t : s.groups[g].triangles) {
      CHECK(owner[t] == -1);
      owner[t] = static_cast<int>(g);
    }
  }
  CHECK(owner == s.group_of_triangle);
  CHECK(area == doctest::Approx(mesh.total_area));
}

/// A tessellated cylinder that was cut up again: vertices lie on the flat sides only, so triangles
/// lie across every edge and no vertex of the wall lies on the true surface.
Mesh cut_up_cylinder(double radius, int sides, int rows) {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  const int columns = 3 * sides;
  for (int row = 0; row <= rows; ++row) {
    for (int c = 0; c < columns; ++c) {
      const int side = c / 3;
      const double t = 0.2 + 0.3 * (c % 3) + 0.12 * std::sin(2.1 * row);
      const double begin = 2 * kPi * side / sides;
      const double end = 2 * kPi * (side + 1) / sides;
      vertices.emplace_back(radius * ((1 - t) * std::cos(begin) + t * std::cos(end)),
                            radius * ((1 - t) * std::sin(begin) + t * std::sin(end)),
                            2.0 * row / rows);
    }
  }
  const auto at = [&](int row, int c) { return row * columns + c % columns; };
  for (int row = 0; row < rows; ++row) {
    for (int c = 0; c < columns; ++c) {
      triangles.push_back({at(row, c), at(row, c + 1), at(row + 1, c + 1)});
      triangles.push_back({at(row, c), at(row + 1, c + 1), at(row + 1, c)});
    }
  }
  const int bottom = static_cast<int>(vertices.size());
  vertices.emplace_back(0, 0, 0);
  vertices.emplace_back(0, 0, 2);
  for (int c = 0; c < columns; ++c) {
    triangles.push_back({bottom, at(0, c + 1), at(0, c)});
    triangles.push_back({bottom + 1, at(rows, c), at(rows, c + 1)});
  }
  return make_mesh(vertices, triangles);
}

TEST_CASE("a cylinder is found from its flat sides when no vertex lies on it any more") {
  const Mesh mesh = solids::transformed(cut_up_cylinder(0.8, 30, 12), solids::oblique_transform());
  const Segmentation s = segmented(mesh);
  check_partition(mesh, s);
  CHECK(s.groups.size() == 3);
  const std::vector<FaceGroup> cylinders = groups_of_kind(s, SurfaceKind::Cylinder);
  REQUIRE(cylinders.size() == 1);
  CHECK(cylinders[0].surface.radius == doctest::Approx(0.8).epsilon(1e-5));
}

/// The wall of a bar along z over a closed polygon, without its ends, in `rows` bands.
Mesh wall(const std::vector<Vec2>& outline, double height, int rows = 1) {
  const int n = static_cast<int>(outline.size());
  std::vector<Vec3> vertices;
  for (int row = 0; row <= rows; ++row) {
    for (const Vec2& p : outline) vertices.emplace_back(p.x(), p.y(), height * row / rows);
  }
  std::vector<std::array<int, 3>> triangles;
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < n; ++i) {
      const int low = row * n;
      const int j = (i + 1) % n;
      triangles.push_back({low + i, low + j, low + n + j});
      triangles.push_back({low + i, low + n + j, low + n + i});
    }
  }
  return make_mesh(vertices, triangles);
}

/// The polygon with each side in four pieces.
std::vector<Vec2> cut_up(const std::vector<Vec2>& outline) {
  std::vector<Vec2> cut;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& next = outline[(i + 1) % outline.size()];
    for (int k = 0; k < 4; ++k) cut.emplace_back(outline[i] + (next - outline[i]) * (0.25 * k));
  }
  return cut;
}

TEST_CASE("surfaces are found where they cut each other's facets") {
  const auto loaded = load_mesh(HEWN_TEST_DATA "/bent_nozzle.off", {}, {});
  REQUIRE(loaded);
  const Segmentation s = segmented(loaded->mesh);
  CHECK(groups_of_kind(s, SurfaceKind::Torus).empty());
  const auto balls = groups_of_kind(s, SurfaceKind::Sphere);
  REQUIRE(balls.size() == 2);
  for (const FaceGroup& ball : balls) {
    CHECK(ball.surface.point.norm() < 1e-3);
    CHECK(ball.surface.radius == doctest::Approx(ball.side > 0 ? 11 : 8).epsilon(1e-4));
  }
  const auto cones = groups_of_kind(s, SurfaceKind::Cone);
  REQUIRE(cones.size() == 2);
  for (const FaceGroup& cone : cones) {
    const double slope = cone.side > 0 ? 6.0 / 42 : 5.0 / 43;
    CHECK(std::tan(cone.surface.half_angle_rad) == doctest::Approx(slope).epsilon(1e-4));
  }
}

TEST_CASE("the walls of a cut-up slot do not belong to its round ends") {
  // The walls run on in the direction of what would be the next side: they touch the inscribed
  // circle like all sides.
  std::vector<Vec2> outline;
  for (const double end : {1.0, -1.0}) {
    for (int k = 0; k < 15; ++k) {
      const double angle = (-84 + 12 * k) * kPi / 180;
      outline.emplace_back(end * Vec2(1.5 + 0.6 * std::cos(angle), 0.6 * std::sin(angle)));
    }
  }
  const Mesh mesh = wall(cut_up(outline), 2, 8);
  const Segmentation s = segmented(mesh);
  check_partition(mesh, s);
  CHECK(s.groups.size() == 4);
  const auto cylinders = groups_of_kind(s, SurfaceKind::Cylinder);
  REQUIRE(cylinders.size() == 2);
  for (const FaceGroup& g : cylinders) {
    CHECK(g.surface.radius == doctest::Approx(0.6).epsilon(1e-4));
    CHECK(g.max_deviation < 0.01);
  }
}

TEST_CASE("tessellated solids are taken apart into the surfaces they were made from") {
  const Affine3 oblique = solids::oblique_transform();
  for (const double jitter : {0.0, 1e-5}) {
    CAPTURE(jitter);
    const auto prepare = [&](const Mesh& solid) {
      const Mesh mesh = solids::transformed(solid, oblique);
      return jittered(mesh, jitter * mesh.diagonal());
    };
    const double slack = 1e-6 + 10 * jitter;

    const Mesh cylinder = prepare(solids::cylinder(0.8, 2, 36));
    const Segmentation c = segmented(cylinder);
    check_partition(cylinder, c);
    REQUIRE(c.groups.size() == 3);
    REQUIRE(groups_of_kind(c, SurfaceKind::Cylinder).size() == 1);
    CHECK(std::abs(groups_of_kind(c, SurfaceKind::Cylinder)[0].surface.radius - 0.8) < slack);

    const Mesh cone = prepare(solids::cone(1, 0.4, 1.5, 40));
    const Segmentation k = segmented(cone);
    check_partition(cone, k);
    REQUIRE(groups_of_kind(k, SurfaceKind::Cone).size() == 1);
    CHECK(std::abs(std::tan(groups_of_kind(k, SurfaceKind::Cone)[0].surface.half_angle_rad) - 0.4) <
          slack);

    const Mesh sphere = prepare(solids::sphere(1.2, 30, 15));
    const Segmentation s = segmented(sphere);
    check_partition(sphere, s);
    REQUIRE(groups_of_kind(s, SurfaceKind::Sphere).size() == 1);
    CHECK(std::abs(groups_of_kind(s, SurfaceKind::Sphere)[0].surface.radius - 1.2) < slack);

    const Mesh torus = prepare(solids::torus(2, 0.5, 48, 24));
    const Segmentation t = segmented(torus);
    check_partition(torus, t);
    REQUIRE(groups_of_kind(t, SurfaceKind::Torus).size() == 1);
    const Surface tube = groups_of_kind(t, SurfaceKind::Torus)[0].surface;
    CHECK(std::abs(tube.radius - 0.5) < slack);
    CHECK(std::abs(tube.major_radius - 2) < slack);
  }
}

TEST_CASE("a hole is a cylinder seen from inside, a boss one seen from outside") {
  const Segmentation hole = segmented(solids::plate_with_hole(Vec3(4, 4, 1), 1, 32));
  REQUIRE(groups_of_kind(hole, SurfaceKind::Cylinder).size() == 1);
  CHECK(groups_of_kind(hole, SurfaceKind::Cylinder)[0].side == -1);
  CHECK(groups_of_kind(hole, SurfaceKind::Plane).size() == 6);
  const Segmentation boss = segmented(solids::cylinder(1, 2, 32));
  REQUIRE(groups_of_kind(boss, SurfaceKind::Cylinder).size() == 1);
  CHECK(groups_of_kind(boss, SurfaceKind::Cylinder)[0].side == 1);
}

TEST_CASE("a fillet is told from the planes that it touches") {
  const Segmentation s = segmented(solids::block_with_fillet(Vec3(3, 2, 1), 0.5, 8));
  const auto fillets = groups_of_kind(s, SurfaceKind::Cylinder);
  REQUIRE(fillets.size() == 1);
  CHECK(fillets[0].surface.radius == doctest::Approx(0.5).epsilon(1e-6));
  CHECK(fillets[0].triangles.size() == 16);
  CHECK(groups_of_kind(s, SurfaceKind::Plane).size() == 6);
}

TEST_CASE("single wide facets do not keep a cylinder from being one") {
  std::vector<Vec2> outline;
  double angle = 0;
  for (int i = 0; i < 36; ++i) {
    outline.emplace_back(std::cos(angle), std::sin(angle));
    // Every third facet spans 20 degrees, two neighbouring ones 35 and 11.
    const double step = i == 5 ? 35 : i == 6 ? 11 : i % 3 == 0 ? 20 : 8;
    angle += step * kPi / 180;
    if (angle > 2 * kPi - 0.1) break;
  }
  const Segmentation s = segmented(wall(outline, 1.5));
  CHECK(s.groups.size() == 1);
  const auto cylinders = groups_of_kind(s, SurfaceKind::Cylinder);
  REQUIRE(cylinders.size() == 1);
  CHECK(cylinders[0].surface.radius == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("a short arc of a cylinder with inexact corners is no cone or torus") {
  Rng rng(5);
  int cylinders = 0;
  int others = 0;
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<Vec2> outline;
    for (int i = 0; i <= 7; ++i) {
      const double angle = 0.2 * (i + 0.25 * rng.uniform(-1, 1));
      outline.emplace_back(std::cos(angle), std::sin(angle));
    }
    for (const Vec2& p : {Vec2(-2, 1.2), Vec2(-2, -1.4), Vec2(1, -1.4)}) outline.push_back(p);
    const Segmentation s = segmented(jittered(wall(outline, 0.4 + 0.05 * trial), 1e-3, trial));
    cylinders += static_cast<int>(groups_of_kind(s, SurfaceKind::Cylinder).size());
    others += static_cast<int>(groups_of_kind(s, SurfaceKind::Cone).size() +
                               groups_of_kind(s, SurfaceKind::Torus).size());
  }
  CHECK(cylinders >= 30);
  CHECK(others == 0);

  const Segmentation cone = segmented(jittered(solids::cone(1, 0.85, 1, 40), 5e-4));
  CHECK(groups_of_kind(cone, SurfaceKind::Cone).size() == 1);
}

TEST_CASE("a misplaced vertex leaves crooked triangles, not planes of the design") {
  const Mesh box = solids::box(Vec3::Zero(), Vec3(4, 3, 2), 8);
  std::vector<Vec3> vertices = box.vertices;
  for (Vec3& p : vertices) {
    if ((p - Vec3(1, 0.75, 2)).norm() > 1e-9) continue;
    // Almost onto a diagonal across, and 0.8 thousandths of the part's diagonal deep.
    p += 0.97 * Vec3(-0.25, 0.1875, 0) + Vec3(0, 0, -0.0043);
  }
  const Segmentation s = segmented(make_mesh(vertices, box.triangles));
  CHECK(s.groups.size() == 6);

  // As deep, but a step along the box's directions: that was meant.
  for (Vec3& p : vertices) {
    if (p.z() > 1.9) p.z() = p.x() > 2.2 ? 1.9957 : 2;
  }
  const Mesh stepped = make_mesh(vertices, box.triangles);
  CHECK(segmented(stepped).groups.size() == 8);
}

TEST_CASE("a fluted bar is no free-form surface, however many flutes join smoothly") {
  constexpr int kArcs = 72;  // alternately ribs and flutes, each tangent to the next
  constexpr int kSteps = 10;
  const double radius = std::sin(kPi / kArcs);
  std::vector<Vec2> outline;
  for (int k = 0; k < kArcs; ++k) {
    const double turn = 2 * kPi * k / kArcs;
    const Vec2 center(std::cos(turn), std::sin(turn));
    const bool is_rib = k % 2 == 0;
    const double half = kPi / 2 + (is_rib ? 1 : -1) * kPi / kArcs;
    for (int i = 0; i < kSteps; ++i) {
      const double a = half * (2.0 * i / kSteps - 1);
      const double angle = is_rib ? turn + a : turn + kPi - a;
      outline.emplace_back(center + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
  }
  const Segmentation s = segmented(wall(outline, 0.5));
  const auto cylinders = groups_of_kind(s, SurfaceKind::Cylinder);
  CHECK(cylinders.size() == kArcs);
  for (const FaceGroup& g : cylinders) {
    CHECK(g.surface.radius == doctest::Approx(radius).epsilon(1e-5));
  }
}

TEST_CASE("a free-form surface is given up early") {
  Mesh blob = solids::sphere(1, 160, 80);
  for (Vec3& p : blob.vertices) {
    const double bumps = std::sin(6 * p.x()) * std::sin(7 * p.y() + 1) * std::sin(8 * p.z() + 2);
    p *= 1 + 0.1 * bumps;
  }
  const Mesh mesh = make_mesh(blob.vertices, blob.triangles);
  const Segmentation s = segmented(mesh);
  check_partition(mesh, s);
  const auto planes = groups_of_kind(s, SurfaceKind::Plane);
  // Without giving up, several hundred small tori.
  CHECK(s.groups.size() - planes.size() <= 61);
  const auto is_fitted = [](const FaceGroup& g) { return g.is_fitted; };
  CHECK(std::count_if(planes.begin(), planes.end(), is_fitted) < 100);
}

TEST_CASE("cutting flat facets into small triangles changes nothing") {
  const Mesh mesh =
      solids::transformed(solids::cylinder(0.8, 2, 36, 12), solids::oblique_transform());
  const Segmentation s = segmented(mesh);
  REQUIRE(groups_of_kind(s, SurfaceKind::Cylinder).size() == 1);
  CHECK(s.groups.size() == 3);
  CHECK(groups_of_kind(s, SurfaceKind::Cylinder)[0].surface.radius ==
        doctest::Approx(0.8).epsilon(1e-6));
}

TEST_CASE("size and place of a part do not matter") {
  for (const double scale : {1e-3, 1e3}) {
    Affine3 move = Affine3::Identity();
    move.translate(Vec3(100, 70, -90) * scale).scale(scale);
    const Segmentation s = segmented(solids::transformed(solids::cylinder(0.8, 2, 36), move));
    REQUIRE(groups_of_kind(s, SurfaceKind::Cylinder).size() == 1);
    CHECK(groups_of_kind(s, SurfaceKind::Cylinder)[0].surface.radius / scale ==
          doctest::Approx(0.8).epsilon(1e-6));
  }
}

/// Upright cylinders of 16 sides in four quarters: the turn from one quarter to the next is too
/// much for one smooth component, and little enough for growth to cross.
Mesh quartered_cylinders(int count) {
  Mesh all;
  for (int i = 0; i < count; ++i) {
    std::vector<double> azimuths = {0};
    for (int q = 0; q < 4; ++q) {
      for (const double width : {24.5, 20.5, 20.5, 24.5}) {
        azimuths.push_back(azimuths.back() + width * kPi / 180);
      }
    }
    std::vector<Vec3> vertices;
    for (const double z : {0.0, 1.0}) {
      for (int k = 0; k < 16; ++k) {
        vertices.emplace_back(3.0 * i + std::cos(azimuths[k]), std::sin(azimuths[k]), z);
      }
    }
    std::vector<std::array<int, 3>> triangles;
    for (int k = 0; k < 16; ++k) {
      const int next = (k + 1) % 16;
      triangles.push_back({k, next, 16 + next});
      triangles.push_back({k, 16 + next, 16 + k});
      if (k < 2) continue;
      triangles.push_back({0, k, k - 1});
      triangles.push_back({16, 16 + k - 1, 16 + k});
    }
    const Mesh one = make_mesh(vertices, triangles);
    all = i == 0 ? one : solids::together(all, one);
  }
  return all;
}

void check_same_to_the_bit(const Segmentation& a, const Segmentation& b) {
  REQUIRE(a.group_of_triangle == b.group_of_triangle);
  for (std::size_t g = 0; g < a.groups.size(); ++g) {
    CHECK(a.groups[g].surface.radius == b.groups[g].surface.radius);
    CHECK(a.groups[g].surface.point == b.groups[g].surface.point);
    CHECK(a.groups[g].surface.axis == b.groups[g].surface.axis);
  }
}

TEST_CASE("surfaces that cross smooth components come out alike for any number of threads") {
  const Mesh mesh = quartered_cylinders(8);
  RunContext one;
  one.threads = 1;
  const auto expected = segment(mesh, {}, one);
  REQUIRE(expected.has_value());
  CHECK(groups_of_kind(*expected, SurfaceKind::Cylinder).size() == 8);
  CHECK(expected->groups.size() == 24);
  for (const int threads : {2, 3, 8}) {
    RunContext run;
    run.threads = threads;
    const auto found = segment(mesh, {}, run);
    REQUIRE(found.has_value());
    check_same_to_the_bit(*expected, *found);
  }
}

TEST_CASE("the sample parts are divided alike for any number of threads") {
  for (const char* part : {"bracket.off", "housing.stl", "elbow.off", "knob.ply"}) {
    CAPTURE(part);
    RunContext run;
    run.threads = 1;
    const auto loaded = load_mesh(std::string(HEWN_ASSETS "/") + part, {}, run);
    REQUIRE(loaded.has_value());
    const auto expected = segment(loaded->mesh, {}, run);
    REQUIRE(expected.has_value());
    for (const int threads : {2, 0}) {
      run.threads = threads;
      const auto found = segment(loaded->mesh, {}, run);
      REQUIRE(found.has_value());
      check_same_to_the_bit(*expected, *found);
    }
  }
}

TEST_CASE("two runs agree to the bit") {
  const Mesh mesh = solids::capsule(0.7, 2, 32, 10);
  const Segmentation a = segmented(mesh);
  const Segmentation b = segmented(mesh);
  CHECK(a.group_of_triangle == b.group_of_triangle);
  REQUIRE(a.groups.size() == b.groups.size());
  for (std::size_t g = 0; g < a.groups.size(); ++g) {
    CHECK(a.groups[g].surface.radius == b.groups[g].surface.radius);
    CHECK((a.groups[g].surface.axis.array() == b.groups[g].surface.axis.array()).all());
  }
}

TEST_CASE("nothing to segment, a wish to stop and unknown methods are errors that say so") {
  const RunContext run;
  const auto empty = segment(make_mesh({}, {}), {}, run);
  REQUIRE_FALSE(empty.has_value());
  CHECK(empty.error().code == ErrorCode::BadMesh);

  RunContext stopped;
  stopped.cancel->cancel();
  const auto cancelled = segment(solids::sphere(1, 30, 15), {}, stopped);
  REQUIRE_FALSE(cancelled.has_value());
  CHECK(cancelled.error().code == ErrorCode::Cancelled);

  SegmentOptions options;
  options.method = 17;
  const auto unknown = segment(solids::sphere(1, 30, 15), options, run);
  REQUIRE_FALSE(unknown.has_value());
  CHECK(unknown.error().code == ErrorCode::InvalidArgument);
}

TEST_CASE("the defaults of the segmentation options lie within their ranges") {
  const auto defaults = std::make_unique<SegmentOptions>();
  for (const OptionField<SegmentOptions>& field : option_table<SegmentOptions>()) {
    CAPTURE(field.name);
    CHECK_FALSE(field.help.empty());
    std::visit(
        [&](auto member) {
          const auto value = static_cast<double>((*defaults).*member);
          CHECK(value >= field.min);
          CHECK(value <= field.max);
        },
        field.member);
  }
}

TEST_CASE("a ring of facets is a chamfer, not a piece of a ball") {
  // A pin with chamfered ends.
  const Mesh pin = solids::revolve({{0, 0}, {4, 0}, {5, 1}, {5, 19}, {4.5, 20}, {0, 20}}, 48);
  const Segmentation s = segmented(pin);
  CHECK(groups_of_kind(s, SurfaceKind::Sphere).empty());
  CHECK(groups_of_kind(s, SurfaceKind::Torus).empty());
  const std::vector<FaceGroup> cones = groups_of_kind(s, SurfaceKind::Cone);
  REQUIRE(cones.size() == 2);
  std::vector<double> angles = {cones[0].surface.half_angle_rad, cones[1].surface.half_angle_rad};
  std::sort(angles.begin(), angles.end());
  CHECK(angles[0] == doctest::Approx(std::atan(0.5)));
  CHECK(angles[1] == doctest::Approx(kPi / 4));
}

TEST_CASE("a cylinder and a cone that join smoothly are no torus") {
  const Mesh hub = solids::revolve({{0, 0}, {17, 0}, {17, 10}, {22, 24}, {0, 24}}, 60);
  const Segmentation s = segmented(hub);
  CHECK(groups_of_kind(s, SurfaceKind::Torus).empty());
  const std::vector<FaceGroup> cylinders = groups_of_kind(s, SurfaceKind::Cylinder);
  REQUIRE(cylinders.size() == 1);
  CHECK(cylinders[0].surface.radius == doctest::Approx(17));
  REQUIRE(groups_of_kind(s, SurfaceKind::Cone).size() == 1);
}

/// A disc whose rim is a band of a torus in `rings` steps, on a straight wall.
Mesh disc_with_round_rim(double major, double minor, double step, int rings, int sides) {
  const double first = -step * rings / 2;
  std::vector<Vec2> profile = {{0, -10}, {major + minor * std::cos(first), -10}};
  for (int k = 0; k <= rings; ++k) {
    const double angle = first + k * step;
    profile.emplace_back(major + minor * std::cos(angle), minor * std::sin(angle));
  }
  profile.emplace_back(0, profile.back().y());
  return solids::revolve(profile, sides);
}

TEST_CASE("a torus of two equally wide rings stays one") {
  const Segmentation s = segmented(disc_with_round_rim(30, 3, kPi / 12, 2, 100));
  CHECK(groups_of_kind(s, SurfaceKind::Torus).size() == 1);
}

TEST_CASE("a narrow band of a torus is no row of oblique cylinders") {
  for (const double major : {15.0, 30.0}) {
    CAPTURE(major);
    const Segmentation s = segmented(disc_with_round_rim(major, major / 6, kPi / 14, 3, 80));
    const auto tori = groups_of_kind(s, SurfaceKind::Torus);
    REQUIRE(tori.size() == 1);
    CHECK(tori[0].surface.radius == doctest::Approx(major / 6));
    CHECK(tori[0].surface.major_radius == doctest::Approx(major));
    CHECK(groups_of_kind(s, SurfaceKind::Cylinder).size() == 1);
  }
}

/// A wheel of radius 10 around z with a bore, from whose rim every third of 36 facets is left;
/// between them it is cut down to `low`.
Mesh toothed_wheel(double low) {
  constexpr int kSides = 36;
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  const auto ring = [&](const auto& radius, double z) {
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2 * kPi * k / kSides;
      vertices.push_back(Vec3(radius(k) * std::cos(angle), radius(k) * std::sin(angle), z));
    }
  };
  const auto outer = [low](int k) { return k % 3 == 2 ? low : 10.0; };
  const auto bore = [](int) { return 3.0; };
  ring(outer, 0);
  ring(outer, 5);
  ring(bore, 5);
  ring(bore, 0);
  // Four bands of quads: rim, top, bore, bottom.
  for (int band = 0; band < 4; ++band) {
    for (int k = 0; k < kSides; ++k) {
      const int a = band * kSides + k;
      const int b = band * kSides + (k + 1) % kSides;
      const int c = (band + 1) % 4 * kSides + k;
      const int d = (band + 1) % 4 * kSides + (k + 1) % kSides;
      triangles.push_back({a, b, d});
      triangles.push_back({a, d, c});
    }
  }
  return make_mesh(vertices, triangles);
}

TEST_CASE("scattered facets about a known axis are one cylinder") {
  const Segmentation s = segmented(toothed_wheel(6));
  std::vector<double> radii;
  for (const FaceGroup& g : groups_of_kind(s, SurfaceKind::Cylinder)) {
    radii.push_back(g.surface.radius);
  }
  std::sort(radii.begin(), radii.end());
  REQUIRE(radii.size() == 2);
  CHECK(radii[0] == doctest::Approx(3));
  CHECK(radii[1] == doctest::Approx(10));
}

/// A hexagonal head around z, 17.3 across its flats and 6.5 high; a cone of slope 1/2 chamfers its
/// corners, in 60 facets that the flats cut.
Mesh chamfered_head() {
  constexpr double kTop = 6.5;
  constexpr double kRim = 9.25;  // of the cone at the top
  const double flat = 10 * std::cos(kPi / 6);
  const double step = 2 * kPi / 60;
  // Where the chord at the top meets a flat: both are that far from the middle of the flat.
  const auto to_flat = [&](double angle) { return flat / std::cos(angle); };
  const auto to_chord = [&](double angle) {
    return kRim * std::cos(step / 2) / std::cos(angle - (std::floor(angle / step) + 0.5) * step);
  };
  double met = 0;
  double beyond = kPi / 6;
  for (int k = 0; k < 60; ++k) {
    const double middle = (met + beyond) / 2;
    (to_flat(middle) < to_chord(middle) ? met : beyond) = middle;
  }
  std::vector<double> within;  // angles from the middle of a flat
  for (int k = -5; k < 5; ++k) within.push_back(k * step);
  within.insert(within.end(), {-met, met});
  std::sort(within.begin(), within.end());
  std::vector<Vec3> vertices{Vec3(0, 0, 0), Vec3(0, 0, kTop)};
  std::vector<std::array<int, 3>> columns;  // bottom, end of the flat, rim of the top
  const auto add = [&](double radius, double angle, double z) {
    vertices.push_back(Vec3(radius * std::cos(angle), radius * std::sin(angle), z));
    return static_cast<int>(vertices.size()) - 1;
  };
  for (int side = 0; side < 6; ++side) {
    for (const double a : within) {
      const double angle = a + side * kPi / 3;
      const double radius = to_flat(a);
      const bool is_cut = std::abs(a) > met;
      const int bottom = add(radius, angle, 0);
      const int end = add(radius, angle, is_cut ? kTop - 2 * (radius - kRim) : kTop);
      columns.push_back({bottom, end, is_cut ? add(kRim, angle, kTop) : end});
    }
  }
  std::vector<Triangle> triangles;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto& [a, b, c] = columns[k];
    const auto& [d, e, f] = columns[(k + 1) % columns.size()];
    triangles.insert(triangles.end(), {{0, d, a}, {1, c, f}, {a, d, e}, {a, e, b}});
    if (e != f) triangles.push_back({b, e, f});
    if (b != c) triangles.push_back({b, f, c});
  }
  return make_mesh(vertices, triangles);
}

TEST_CASE("slivers of one plane beside an axis are no cylinder about it") {
  Mesh part = solids::plate_with_hole({40, 40, 5}, 5, 48);
  for (int i = -3; i <= 3; ++i) {
    const double y = 1.4 * i;
    part = solids::together(part, solids::box({130, y - 0.15, 0}, {131, y + 0.15, 5}));
  }
  const std::vector<FaceGroup> cylinders = groups_of_kind(segmented(part), SurfaceKind::Cylinder);
  REQUIRE(cylinders.size() == 1);
  CHECK(cylinders[0].surface.radius == doctest::Approx(5));
}

TEST_CASE("short pieces of a cone about a known axis are one cone") {
  const Mesh shank = solids::cylinder(5, 30, 60);
  const Segmentation s = segmented(solids::together(chamfered_head(), shank));
  const std::vector<FaceGroup> cones = groups_of_kind(s, SurfaceKind::Cone);
  REQUIRE(cones.size() == 1);
  CHECK(cones[0].surface.half_angle_rad == doctest::Approx(std::atan(0.5)));
  CHECK(std::abs(cones[0].surface.axis.z()) == doctest::Approx(1));
  CHECK(cones[0].surface.point.z() == doctest::Approx(25));
  CHECK(groups_of_kind(s, SurfaceKind::Cylinder).size() == 1);
}

}  // namespace
}  // namespace hewn
