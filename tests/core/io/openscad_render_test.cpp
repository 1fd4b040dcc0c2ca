// The exported text run through the real OpenSCAD and compared with the tree.
#include <cstdio>

#include <doctest/doctest.h>

#include "core/csg/literal.h"
#include "core/io/openscad.h"
#include "scad_rendering.h"
#include "tests/core/csg/box.h"
#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

Mat3 about(const Vec3& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * kPi / 180, axis).toRotationMatrix();
}

using testing::box;

Literal cylinder(const Vec3& base, double radius, double height) {
  Literal s;
  s.kind = SolidKind::Cylinder;
  s.origin = base;
  s.radius = s.top_radius = radius;
  s.height = height;
  return s;
}

bool is_closed(const Mesh& mesh) {
  for (const Edge& edge : build_edges(mesh)) {
    if (edge.triangles.size() % 2 != 0) return false;
  }
  return true;
}

Literal as_literal(const Mesh& mesh) {
  Literal s;
  s.kind = SolidKind::Polyhedron;
  s.polyhedron = std::make_shared<const Mesh>(mesh);
  return s;
}

/// Points farther than `band` from the tree's boundary that mesh and tree classify differently.
int disagreements(const Tree& tree, const Mesh& mesh, double band, Rng& rng) {
  const Literal rendered = as_literal(mesh);
  const Box3 box = tree.bounds();
  int wrong = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 x = box.center() + testing::random_point(rng, 0.55).cwiseProduct(box.size());
    const double d = tree.signed_distance(x);
    if (std::abs(d) > band && (rendered.signed_distance(x) < 0) != (d < 0)) ++wrong;
  }
  return wrong;
}

/// Largest distance of the mesh's vertices from the tree's boundary (a sheet's corners stray).
double farthest_vertex(const Tree& tree, const Mesh& mesh) {
  double farthest = 0;
  for (const Vec3& v : mesh.vertices) {
    farthest = std::max(farthest, std::abs(tree.signed_distance(v)));
  }
  return farthest;
}

void check_rendering(const Tree& tree, double size, Rng& rng,
                     const testing::ScratchFolder& folder) {
  const std::string scad = to_openscad(tree, {}, {.segments = 24});
  CAPTURE(scad);
  const std::optional<Mesh> mesh = testing::render(scad, folder);
  REQUIRE(mesh);
  CHECK(is_closed(*mesh));
  CHECK(disagreements(tree, *mesh, 0.02 * size, rng) == 0);
  CHECK(farthest_vertex(tree, *mesh) < 0.02 * size);
}

bool has_volume(const Tree& tree, Rng& rng) {
  const Box3 box = tree.bounds();
  if (box.is_empty()) return false;
  int inside = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 x = box.center() + testing::random_point(rng, 0.5).cwiseProduct(box.size());
    inside += tree.contains(x) ? 1 : 0;
  }
  return inside > 10;
}

TEST_CASE("random trees of all sizes render as what they are") {
  const testing::ScratchFolder folder;
  Rng rng(61);
  for (const double scale : {1.0, 0.001, 1000.0}) {
    for (int done = 0; done < 4;) {
      const Tree tree = testing::random_tree(rng, {.depth = 2, .has_names = true, .scale = scale});
      if (!has_volume(tree, rng)) continue;
      check_rendering(tree, scale, rng, folder);
      ++done;
    }
  }
}

TEST_CASE("flush tools leave no sheets, whatever the part's frame and scale") {
  const testing::ScratchFolder folder;
  Rng rng(62);
  for (const double scale : {1.0, 0.001, 1000.0}) {
    for (const bool is_turned : {false, true}) {
      const Mat3 turn = is_turned ? testing::random_rotation(rng) : Mat3(Mat3::Identity());
      const double third = scale / 3;
      Tree tree;
      const int block = tree.add_literal(box({0, 0, 0}, Vec3(4, 3, 2) * third, turn));
      const int notch = tree.add_literal(box(Vec3(0, 1, 1) * third, Vec3(2, 2, 2) * third, turn));
      Literal hole = cylinder(Vec3(3, 1.5, 0) * third, third / 3, 2 * third);
      hole.rotation = turn;
      const int drilled = tree.add_literal(hole);
      tree.root = tree.add_node(Op::Difference, {block, notch, drilled});
      const auto mesh = testing::render(to_openscad(tree, {}, {}), folder);
      REQUIRE(mesh);
      CHECK(is_closed(*mesh));
      CHECK(farthest_vertex(tree, *mesh) < 1e-4 * scale);
      const double cube = third * third * third;
      // A circle of 96 chords has sin(2 pi / 96) 96 / 2 of its radius squared.
      const double disc = std::sin(2 * kPi / 96) * 48 / 9;
      CHECK(mesh->volume == doctest::Approx((24 - 2 - 2 * disc) * cube).epsilon(1e-4));
    }
  }
}

TEST_CASE("stacked boxes with irrational faces weld into one block") {
  const testing::ScratchFolder folder;
  for (const double scale : {1.0, 0.001, 1000.0}) {
    const Mat3 turn = about(Vec3::UnitZ(), 27) * about(Vec3::UnitX(), 11);
    Tree tree;
    std::vector<int> slabs;
    for (int i = 0; i < 6; ++i) {
      const double lo = std::sqrt(i) * scale;
      const double hi = std::sqrt(i + 1) * scale;
      slabs.push_back(tree.add_literal(box({0, 0, lo}, {scale, scale, hi}, turn)));
    }
    tree.root = tree.add_node(Op::Union, slabs);
    const auto mesh = testing::render(to_openscad(tree, {}, {}), folder);
    REQUIRE(mesh);
    CHECK(mesh->vertices.size() == 8);
    CHECK(mesh->volume == doctest::Approx(std::sqrt(6.0) * scale * scale * scale).epsilon(1e-4));
  }
}

TEST_CASE("every kind of solid lands where the tree has it at any angle") {
  const testing::ScratchFolder folder;
  Rng rng(63);
  const Mat3 turns[] = {about(Vec3::UnitX(), 90),  about(Vec3::UnitX(), -90),
                        about(Vec3::UnitY(), 90),  about(Vec3::UnitY(), -90),
                        about(Vec3::UnitY(), 180), testing::random_rotation(rng)};
  for (const Mat3& turn : turns) {
    Literal cone = cylinder({-3, 0.5, 0.2}, 1, 2);
    cone.top_radius = 0.3;
    Literal torus;
    torus.kind = SolidKind::Torus;
    torus.origin = Vec3(3, 0, 1);
    torus.major_radius = 1;
    torus.radius = 0.4;
    Literal spindle = torus;
    spindle.origin = Vec3(0, 4, 1);
    spindle.major_radius = 0.3;
    spindle.radius = 0.8;
    Literal ball = torus;
    ball.kind = SolidKind::Sphere;
    ball.origin = Vec3(0, -4, 0);
    Tree tree;
    std::vector<int> leaves;
    Literal nut = torus;
    nut.kind = SolidKind::Prism;
    nut.origin = Vec3(-3, 4, 0.5);
    nut.sides = 5;
    nut.height = 1.5;
    for (Literal s : {cone, torus, spindle, ball, nut}) {
      s.rotation = turn;
      leaves.push_back(tree.add_literal(s));
    }
    // A second frame keeps the whole from being turned at once.
    leaves.push_back(tree.add_literal(box({-1, -1, -1}, {1, 1, 1})));
    tree.root = tree.add_node(Op::Union, leaves);
    check_rendering(tree, 2, rng, folder);
  }
}

TEST_CASE("matched facets reproduce the mesh's own polygon exactly") {
  const testing::ScratchFolder folder;
  Rng rng(64);
  const Mat3 turns[] = {Mat3::Identity(), about(Vec3::UnitX(), 90), about(Vec3::UnitY(), -90),
                        testing::random_rotation(rng)};
  for (const Mat3& turn : turns) {
    Literal rod = cylinder({1, 2, 3}, 2, 5);
    rod.rotation = turn;
    rod.facets.sides = 30;
    rod.facets.phase_rad = 0.1;
    Tree tree;
    tree.root = tree.add_literal(rod);
    const auto mesh = testing::render(to_openscad(tree, {}, {.match_facets = true}), folder);
    REQUIRE(mesh);
    CHECK(mesh->vertices.size() == 60);
    double farthest = 0;
    for (int i = 0; i < 30; ++i) {
      const double angle = 0.1 + 2 * kPi * i / 30;
      const Vec3 wanted = rod.to_world({2 * std::cos(angle), 2 * std::sin(angle), 0});
      double nearest = kInfinity;
      for (const Vec3& v : mesh->vertices) nearest = std::min(nearest, (v - wanted).norm());
      farthest = std::max(farthest, nearest);
    }
    CHECK(farthest < 3e-5);
  }
}

TEST_CASE("matched facets reproduce a torus and a sphere exactly") {
  const testing::ScratchFolder folder;
  Rng rng(65);
  Literal torus;
  torus.kind = SolidKind::Torus;
  torus.rotation = testing::random_rotation(rng);
  torus.major_radius = 3;
  torus.radius = 1;
  torus.facets = {20, 0.1, 12, 0.2};
  Tree tree;
  tree.root = tree.add_literal(torus);
  const auto ring = testing::render(to_openscad(tree, {}, {.match_facets = true}), folder);
  REQUIRE(ring);
  CHECK(ring->vertices.size() == 240);
  double farthest = 0;
  for (const Vec3& v : ring->vertices) {
    const Vec3 p = torus.to_local(v);
    const double around = (std::atan2(p.y(), p.x()) - 0.1) / (2 * kPi / 20);
    const double tube = (std::atan2(p.z(), std::hypot(p.x(), p.y()) - 3) - 0.2) / (2 * kPi / 12);
    farthest = std::max({farthest, std::abs(around - std::round(around)),
                         std::abs(tube - std::round(tube)), std::abs(torus.signed_distance(v))});
  }
  CHECK(farthest < 1e-4);

  Literal ball = torus;
  ball.kind = SolidKind::Sphere;
  ball.facets = {16, 0.1, 8, 0};
  Tree single;
  single.root = single.add_literal(ball);
  const auto globe = testing::render(to_openscad(single, {}, {.match_facets = true}), folder);
  REQUIRE(globe);
  CHECK(globe->vertices.size() == 128);
  farthest = 0;
  for (const Vec3& v : globe->vertices) {
    const Vec3 p = ball.to_local(v);
    const double around = (std::atan2(p.y(), p.x()) - 0.1) / (2 * kPi / 16);
    farthest = std::max(farthest, std::abs(around - std::round(around)));
  }
  CHECK(farthest < 1e-4);
}

}  // namespace
}  // namespace hewn
