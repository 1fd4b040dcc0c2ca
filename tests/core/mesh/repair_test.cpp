#include <algorithm>

#include <doctest/doctest.h>

#include "core/mesh/load.h"
#include "core/mesh/query.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

LoadedMesh repaired(const Mesh& mesh) {
  auto loaded = repair_mesh(mesh.vertices, mesh.triangles, {}, {});
  REQUIRE(loaded);
  return *std::move(loaded);
}

/// Every triangle with vertices of its own, as in an STL file.
Mesh unwelded(const Mesh& mesh) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const int first = static_cast<int>(vertices.size());
    for (int k = 0; k < 3; ++k) vertices.push_back(mesh.corner(t, k));
    triangles.push_back({first, first + 1, first + 2});
  }
  return make_mesh(std::move(vertices), std::move(triangles));
}

void turn(Mesh& mesh, int triangle) {
  std::swap(mesh.triangles[triangle][0], mesh.triangles[triangle][1]);
}

TEST_CASE("vertices within the tolerance become one, across grid cells too") {
  Mesh soup = unwelded(solids::sphere(1, 24, 12));
  const std::size_t before = soup.vertices.size();
  Rng rng(5);
  for (Vec3& v : soup.vertices) {
    for (double& c : v) c += rng.uniform(-2e-7, 2e-7);
  }
  const LoadedMesh loaded = repaired(soup);
  const Mesh sphere = solids::sphere(1, 24, 12);
  CHECK(loaded.mesh.vertices.size() == sphere.vertices.size());
  CHECK(loaded.report.vertices_welded == static_cast<int>(before - sphere.vertices.size()));
  CHECK(loaded.report.is_closed);
}

TEST_CASE("features just above the tolerance survive welding") {
  const double gap = 5e-6;
  const LoadedMesh loaded = repaired(
      solids::together(solids::box({0, 0, 0}, {1, 1, 1}), solids::box({1 + gap, 0, 0}, {2, 1, 1})));
  CHECK(loaded.report.vertices_welded == 0);
  CHECK(loaded.report.components == 2);
}

TEST_CASE("a flat triangle goes and its neighbour is split, so that the surface stays closed") {
  // A box whose one edge carries a midpoint that only a zero-area triangle knows of.
  Mesh box = solids::box({0, 0, 0}, {1, 1, 1});
  const Edge edge = build_edges(box)[0];
  const int middle = static_cast<int>(box.vertices.size());
  box.vertices.push_back((box.vertices[edge.a] + box.vertices[edge.b]) / 2);
  const int t = edge.triangles[0];
  Triangle old = box.triangles[t];
  Triangle one = old;
  Triangle two = old;
  std::replace(one.begin(), one.end(), edge.a, middle);
  std::replace(two.begin(), two.end(), edge.b, middle);
  box.triangles[t] = one;
  box.triangles.push_back(two);
  // The gap between the split and the unsplit side is filled by a triangle of no area.
  const bool runs_up = (old[0] == edge.a && old[1] == edge.b) ||
                       (old[1] == edge.a && old[2] == edge.b) ||
                       (old[2] == edge.a && old[0] == edge.b);
  box.triangles.push_back(runs_up ? Triangle{edge.b, middle, edge.a}
                                  : Triangle{edge.a, middle, edge.b});
  std::rotate(box.triangles.back().begin(), box.triangles.back().begin() + 1,
              box.triangles.back().end());
  REQUIRE(solids::is_closed(make_mesh(box.vertices, box.triangles)));
  const LoadedMesh loaded = repaired(box);
  CHECK(loaded.report.zero_area_removed == 1);
  CHECK(loaded.report.is_closed);
  CHECK(*std::min_element(loaded.mesh.areas.begin(), loaded.mesh.areas.end()) > 0.1);
  CHECK(loaded.mesh.volume == doctest::Approx(1));
}

TEST_CASE("a triangle given twice is kept once") {
  Mesh box = solids::box({0, 0, 0}, {1, 1, 1});
  box.triangles.push_back(box.triangles[3]);
  box.triangles.push_back(box.triangles[3]);
  const LoadedMesh loaded = repaired(box);
  CHECK(loaded.report.duplicates_removed == 2);
  CHECK(loaded.mesh.triangles.size() == 12);
  CHECK(loaded.report.is_closed);
}

TEST_CASE("of a surface that is there twice as a whole one copy stays") {
  const Mesh box = solids::box({0, 0, 0}, {1, 1, 1});
  const Mesh apart = solids::box({5, 0, 0}, {6, 1, 1});
  Mesh turned = box;
  for (int t = 0; t < 12; ++t) turn(turned, t);
  for (const Mesh& copy : {box, turned}) {
    const LoadedMesh loaded = repaired(solids::together(solids::together(box, apart), copy));
    CHECK(loaded.report.duplicates_removed == 12);
    CHECK(loaded.report.is_closed);
    CHECK(loaded.mesh.triangles.size() == 24);
    CHECK(loaded.mesh.volume == doctest::Approx(2));
  }
}

TEST_CASE("the wall between two boxes that touch is removed") {
  const Mesh left = solids::box({0, 0, 0}, {1, 1, 1});
  Mesh right = left;  // mirrored, so that the walls have the same triangles
  for (Vec3& v : right.vertices) v.x() = 2 - v.x();
  for (int t = 0; t < 12; ++t) turn(right, t);
  const LoadedMesh loaded = repaired(solids::together(left, right));
  CHECK(loaded.report.duplicates_removed == 4);
  CHECK(loaded.report.is_closed);
  CHECK(loaded.report.components == 1);
  CHECK(loaded.mesh.volume == doctest::Approx(2));
}

TEST_CASE("single turned triangles are turned back") {
  Mesh sphere = solids::sphere(1, 24, 12);
  for (const int t : {0, 7, 100, 101, 200}) turn(sphere, t);
  const LoadedMesh loaded = repaired(sphere);
  CHECK(loaded.report.triangles_flipped == 5);
  CHECK(!loaded.report.was_inside_out);
  CHECK(solids::is_closed(loaded.mesh));
  CHECK(loaded.mesh.volume > 4);
}

TEST_CASE("an inside-out solid is turned and said to have been") {
  Mesh sphere = solids::sphere(1, 24, 12);
  for (int t = 0; t < static_cast<int>(sphere.triangles.size()); ++t) turn(sphere, t);
  const LoadedMesh loaded = repaired(sphere);
  CHECK(loaded.report.was_inside_out);
  CHECK(loaded.report.triangles_flipped == 0);
  CHECK(loaded.mesh.volume > 4);
  REQUIRE(loaded.report.warnings.size() == 1);
  CHECK(loaded.report.warnings[0].find("inside out") != std::string::npos);
}

TEST_CASE("a cavity points inward whichever way it came, a solid within a cavity outward") {
  const Mesh outer = solids::sphere(3, 32, 16);
  Mesh cavity = solids::box({-1, -1, -1}, {1, 1, 1});
  const Mesh core = solids::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  for (const bool comes_inward : {false, true}) {
    if (comes_inward) {
      for (int t = 0; t < 12; ++t) turn(cavity, t);
    }
    const LoadedMesh loaded = repaired(solids::together(solids::together(outer, cavity), core));
    CHECK(loaded.report.components == 3);
    CHECK(loaded.mesh.volume == doctest::Approx(outer.volume - 8 + 1));
    const MeshQuery query(std::make_shared<const Mesh>(loaded.mesh));
    CHECK(query.contains({0, 0, 2}));
    CHECK(!query.contains({0, 0, 0.75}));
    CHECK(query.contains({0, 0, 0.25}));
  }
}

TEST_CASE("overlapping solids both count as inside and their crossings are reported") {
  const LoadedMesh loaded = repaired(
      solids::together(solids::box({0, 0, 0}, {2, 2, 2}), solids::box({1, 1, 1}, {3, 3, 3})));
  CHECK(loaded.report.self_intersections > 0);
  const MeshQuery query(std::make_shared<const Mesh>(loaded.mesh));
  CHECK(query.contains({1.5, 1.5, 1.5}));
  CHECK(query.contains({0.5, 0.5, 0.5}));
  CHECK(!query.contains({2.5, 0.5, 0.5}));
}

TEST_CASE("a clean solid has nothing to report") {
  const LoadedMesh loaded = repaired(solids::plate_with_hole({4, 4, 1}, 1, 32));
  CHECK(loaded.report.warnings.empty());
  CHECK(loaded.report.self_intersections == 0);
  CHECK(loaded.report.components == 1);
  CHECK(loaded.report.is_closed);
}

TEST_CASE("holes are counted as loops") {
  Mesh sphere = solids::sphere(1, 24, 12);
  sphere.triangles.erase(sphere.triangles.begin() + 300);
  sphere.triangles.erase(sphere.triangles.begin() + 100);
  const LoadedMesh loaded = repaired(sphere);
  CHECK(loaded.report.holes == 2);
  CHECK(loaded.report.boundary_edges == 6);
  CHECK(!loaded.report.is_closed);
  const MeshQuery query(std::make_shared<const Mesh>(loaded.mesh));
  CHECK(query.contains({0.1, 0.2, -0.1}));
}

TEST_CASE("two boxes that share an edge have a non-manifold edge and both stay outward") {
  const LoadedMesh loaded = repaired(
      solids::together(solids::box({0, 0, 0}, {1, 1, 1}), solids::box({1, 1, 0}, {2, 2, 1})));
  CHECK(loaded.report.non_manifold_edges == 1);
  CHECK(loaded.report.is_closed);
  CHECK(loaded.mesh.volume == doctest::Approx(2));
}

TEST_CASE("a mesh without area, with bad indices or NaN is refused") {
  const auto flat = repair_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, {}, {});
  REQUIRE(!flat);
  CHECK(flat.error().code == ErrorCode::BadMesh);
  CHECK(flat.error().message.find("no triangle") != std::string::npos);
  const auto range = repair_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}}, {}, {});
  REQUIRE(!range);
  CHECK(range.error().where == "triangle 0");
  const auto nan = repair_mesh({{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}}, {{0, 1, 2}}, {}, {});
  REQUIRE(!nan);
  CHECK(nan.error().where == "vertex 2");
  const auto empty = repair_mesh({}, {}, {}, {});
  REQUIRE(!empty);
  CHECK(empty.error().code == ErrorCode::BadMesh);
}

}  // namespace
}  // namespace hewn
