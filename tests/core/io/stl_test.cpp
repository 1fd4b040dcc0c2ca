#include "core/io/stl.h"

#include <filesystem>

#include <doctest/doctest.h>

#include "core/base/file.h"
#include "core/io/step.h"
#include "core/mesh/load.h"
#include "scratch_folder.h"
#include "tests/core/csg/box.h"
#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

using testing::box;

Literal round_literal(SolidKind kind, double radius, double major_radius, double height) {
  Literal s;
  s.kind = kind;
  s.radius = s.top_radius = radius;
  s.major_radius = major_radius;
  s.height = height;
  return s;
}

Tree drilled_plate(double scale) {
  Tree tree;
  const int plate = tree.add_literal(box({0, 0, 0}, Vec3(4, 3, 1) * scale));
  Literal hole = round_literal(SolidKind::Cylinder, 0.5 * scale, 0, scale);
  hole.origin = Vec3(2, 1.5, 0) * scale;
  const int drilled = tree.add_literal(hole);
  tree.root = tree.add_node(Op::Difference, {plate, drilled});
  return tree;
}

TEST_CASE("a plate with a flush hole has the right volume at every scale") {
  for (const double scale : {1.0, 0.001, 1000.0}) {
    const Result<Mesh> mesh = tessellate(drilled_plate(scale), {}, {});
    REQUIRE(mesh);
    const double cube = scale * scale * scale;
    CHECK(mesh->volume == doctest::Approx((12 - kPi / 4) * cube).epsilon(1e-3));
  }
}

TEST_CASE("each kind of solid has its volume") {
  const auto volume = [](const Literal& s) {
    Tree tree;
    tree.root = tree.add_literal(s);
    const Result<Mesh> mesh = tessellate(tree, {.angle_deg = 6}, {});
    REQUIRE(mesh);
    return mesh->volume;
  };
  CHECK(volume(round_literal(SolidKind::Sphere, 1, 0, 0)) ==
        doctest::Approx(4 * kPi / 3).epsilon(1e-2));
  CHECK(volume(round_literal(SolidKind::Torus, 1, 3, 0)) ==
        doctest::Approx(6 * kPi * kPi).epsilon(1e-2));
  Literal nut = round_literal(SolidKind::Prism, 1, 0, 2);
  nut.sides = 6;
  CHECK(volume(nut) == doctest::Approx(2 * 2 * std::sqrt(3)));
  Literal cone = round_literal(SolidKind::Cylinder, 2, 0, 3);
  cone.top_radius = 0;
  CHECK(volume(cone) == doctest::Approx(4 * kPi).epsilon(1e-2));
  // Revolved circle segment (Pappus), here by numerical integration of its slices.
  const double major = 0.5;
  double spindle = 0;
  for (int i = 0; i < 20000; ++i) {
    const double h = -1 + (i + 0.5) / 10000;
    const double half = std::sqrt(1 - h * h);
    const double inner = std::max(0.0, major - half);
    spindle += kPi * ((major + half) * (major + half) - inner * inner) / 10000;
  }
  CHECK(volume(round_literal(SolidKind::Torus, 1, major, 0)) ==
        doctest::Approx(spindle).epsilon(1e-2));
}

TEST_CASE("random trees become closed meshes that agree with them") {
  Rng rng(81);
  int built = 0;
  int offered = 0;
  while (offered < 15) {
    const Tree tree = testing::random_tree(rng, {.depth = 2, .has_complements = true});
    int inside = 0;
    for (int i = 0; i < 500; ++i) inside += tree.contains(testing::random_point(rng, 2)) ? 1 : 0;
    if (inside < 10) continue;
    ++offered;
    const Result<Mesh> mesh = tessellate(tree, {.angle_deg = 15, .deflection = 0.01}, {});
    if (!mesh) {
      MESSAGE(mesh.error().message);
      continue;
    }
    ++built;
    CHECK(mesh->volume > 0);
  }
  CHECK(built >= 13);
}

TEST_CASE("an empty tree and senseless options are refused with words") {
  const Result<Mesh> empty = tessellate(Tree{}, {}, {});
  REQUIRE_FALSE(empty);
  CHECK(empty.error().code == ErrorCode::InvalidArgument);
  CHECK(empty.error().message.find("empty") != std::string::npos);
  CHECK_FALSE(tessellate(drilled_plate(1), {.angle_deg = 0}, {}));
}

TEST_CASE("a cancelled export stops") {
  RunContext run;
  run.cancel->cancel();
  const Result<Mesh> mesh = tessellate(drilled_plate(1), {}, run);
  REQUIRE_FALSE(mesh);
  CHECK(mesh.error().code == ErrorCode::Cancelled);
}

TEST_CASE("mesh and STEP files can be read again") {
  const testing::ScratchFolder folder;
  const auto stl = folder / "plate.stl";
  REQUIRE(write_mesh(drilled_plate(1), stl, {}, {}));
  const Result<LoadedMesh> back = load_mesh(stl, {}, {});
  REQUIRE(back);
  CHECK(back->report.is_closed);
  CHECK(back->mesh.volume == doctest::Approx(12 - kPi / 4).epsilon(1e-3));
  const auto step = folder / "plate.step";
  REQUIRE(write_step(drilled_plate(1), step, {}));
  const Result<std::string> text = read_file(step);
  REQUIRE(text);
  CHECK(text->find("CYLINDRICAL_SURFACE") != std::string::npos);
  CHECK(text->find("END-ISO-10303-21") != std::string::npos);
  const auto bad = write_step(drilled_plate(1), "/no/such/folder/x.step", {});
  REQUIRE_FALSE(bad);
  CHECK(bad.error().code == ErrorCode::FileWrite);
}

}  // namespace
}  // namespace hewn
