#include "core/synth/find_tree.h"

#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "core/mesh/load.h"
#include "tests/support/part_problem.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

TreeAnswer find(const solids::PartProblem& part) {
  TreeProblem problem;
  problem.query = &part.query;
  problem.segmentation = &part.segmentation;
  problem.surfaces = &part.surfaces;
  auto answer = find_tree(problem, {}, part.run);
  REQUIRE(answer.has_value());
  return *answer;
}

TEST_CASE("simple solids come back as the one or two literals they are") {
  const solids::PartProblem box(solids::box({-1, -2, 0}, {4, 3, 7}));
  CHECK(literal_count(find(box).tree) == 1);
  const solids::PartProblem cylinder(solids::cylinder(2, 9, 32));
  CHECK(literal_count(find(cylinder).tree) == 1);
  const solids::PartProblem plate(solids::plate_with_hole({10, 8, 2}, 2, 32));
  CHECK(literal_count(find(plate).tree) == 2);
}

TEST_CASE("bars that end unseen come back as the primitives they were made as") {
  const std::pair<std::string, int> made_of[] = {
      {"/spoked_wheel.off", 9}, {"/hub_with_rods.off", 9}, {"/rotor.off", 7}, {"/fan.off", 10}};
  for (const auto& [name, literals] : made_of) {
    CAPTURE(name);
    auto loaded = load_mesh(HEWN_TEST_DATA + name, {}, {});
    REQUIRE(loaded);
    const solids::PartProblem part(std::move(loaded->mesh));
    CHECK(literal_count(find(part).tree) <= literals);
  }
}

TEST_CASE("a solid turned and moved gives as small a tree as in its own frame") {
  const Mesh plate = solids::plate_with_hole({10, 8, 2}, 2, 32);
  const solids::PartProblem turned(solids::transformed(plate, solids::oblique_transform()));
  const TreeAnswer answer = find(turned);
  CHECK(literal_count(answer.tree) == 2);
  CHECK(answer.agreement > 0.9999);
}

TEST_CASE("the exact dimensions are recovered") {
  const solids::PartProblem part(solids::plate_with_hole({10, 8, 2}, 1.75, 32));
  const TreeAnswer answer = find(part);
  for (const Literal& l : answer.tree.literals) {
    if (l.kind == SolidKind::Cylinder) CHECK(l.radius == doctest::Approx(1.75).epsilon(1e-9));
    if (l.kind == SolidKind::Box) CHECK((l.size - Vec3(10, 8, 2)).norm() < 1e-9);
  }
}

TEST_CASE("a rounded edge is built from boxes along the part") {
  const solids::PartProblem part(solids::block_with_fillet({6, 5, 4}, 1.5, 16));
  const TreeAnswer answer = find(part);
  CHECK(literal_count(answer.tree) == 3);
  for (const Literal& l : answer.tree.literals) {
    if (l.kind == SolidKind::Cylinder) CHECK(l.radius == doctest::Approx(1.5).epsilon(1e-9));
    if (l.kind != SolidKind::Box) continue;
    for (int k = 0; k < 9; ++k) {
      const double c = std::abs(l.rotation(k / 3, k % 3));
      CHECK((c < 1e-12 || std::abs(c - 1) < 1e-12));
    }
  }
}

TEST_CASE("the tree is the same for any number of threads") {
  const auto literals_with = [](int threads) {
    solids::PartProblem part(solids::block_with_fillet({6, 5, 4}, 1.5, 12));
    part.run.threads = threads;
    std::vector<Vec3> out;
    for (const Literal& l : find(part).tree.literals) {
      out.push_back(l.origin);
      out.push_back(l.size);
      out.emplace_back(l.radius, l.top_radius, l.height);
    }
    return out;
  };
  const auto one = literals_with(1);
  CHECK(one == literals_with(2));
  CHECK(one == literals_with(8));
}

TEST_CASE("a subtracted partition yields the tool that made it") {
  const solids::PartProblem part(solids::plate_with_hole({10, 8, 2}, 2, 32));
  TreeProblem problem;
  problem.query = &part.query;
  problem.segmentation = &part.segmentation;
  problem.surfaces = &part.surfaces;
  problem.is_subtracted = true;
  for (std::size_t g = 0; g < part.segmentation.groups.size(); ++g) {
    if (part.segmentation.groups[g].surface.kind == SurfaceKind::Cylinder) {
      problem.groups.push_back(static_cast<int>(g));
    }
  }
  const auto tool = find_tree(problem, {}, part.run);
  REQUIRE(tool.has_value());
  REQUIRE(literal_count(tool->tree) == 1);
  CHECK(tool->tree.literals[0].kind == SolidKind::Cylinder);
  CHECK(tool->tree.contains({0, 0, 0.99}));
  CHECK(tool->tree.contains({0, 0, 1.01}));
}

TEST_CASE("a part without surfaces is reported, and a cancelled search ends") {
  const solids::PartProblem part(solids::box({0, 0, 0}, {1, 1, 1}));
  TreeProblem problem;
  problem.query = &part.query;
  problem.segmentation = &part.segmentation;
  const SurfaceSet none;
  problem.surfaces = &none;
  const auto nothing = find_tree(problem, {}, part.run);
  REQUIRE(!nothing.has_value());
  CHECK(nothing.error().code == ErrorCode::NotFound);
  problem.surfaces = &part.surfaces;
  part.run.cancel->cancel();
  const auto stopped = find_tree(problem, {}, part.run);
  REQUIRE(!stopped.has_value());
  CHECK(stopped.error().code == ErrorCode::Cancelled);
}

}  // namespace
}  // namespace hewn
