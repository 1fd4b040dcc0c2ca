// The score of a tree against a mesh, where both are known exactly.
#include "core/session/score.h"

#include <cmath>
#include <memory>

#include <doctest/doctest.h>

#include "tests/support/solids.h"

namespace hewn {
namespace {

Tree cube_tree(double side) {
  Literal cube;
  cube.size = Vec3::Constant(side);
  Tree tree;
  tree.root = tree.add_literal(cube);
  return tree;
}

TreeScore scored(const Tree& tree, int threads = 0) {
  const Mesh mesh = solids::box(Vec3::Zero(), Vec3::Constant(10));
  const MeshQuery query(std::make_shared<const Mesh>(mesh));
  RunContext run;
  run.threads = threads;
  const auto score = score_tree(query, tree, VerifySettings{}, run);
  REQUIRE(score);
  return *score;
}

TEST_CASE("a tree that is the mesh scores as one") {
  const TreeScore score = scored(cube_tree(10));
  CHECK(score.iou == 1);
  CHECK(score.agreement == 1);
  CHECK(score.hausdorff < 1e-6);
}

TEST_CASE("a tree larger than the mesh counts wherever it reaches") {
  // The mesh's own surroundings hold little of a cube with 27 times its volume.
  CHECK(scored(cube_tree(30)).iou == doctest::Approx(1.0 / 27).epsilon(0.05));
  CHECK(scored(cube_tree(11)).iou == doctest::Approx(1000.0 / 1331).epsilon(0.03));
  CHECK(scored(cube_tree(5)).iou == doctest::Approx(1.0 / 8).epsilon(0.05));
}

TEST_CASE("a tree that misses the mesh shares nothing with it") {
  Tree tree = cube_tree(5);
  tree.literals[0].origin = Vec3::Constant(40);
  CHECK(scored(tree).iou == 0);
  CHECK(scored(Tree{}).iou == 0);
}

TEST_CASE("a small feature that sticks out counts, though few lines through the part meet it") {
  Tree tree = cube_tree(10);
  Literal spike;
  spike.kind = SolidKind::Cylinder;
  spike.radius = spike.top_radius = 0.02;
  spike.height = 0.6;
  spike.origin = Vec3(3, 7, 9.9);
  const int cube = tree.root;
  const int pin = tree.add_literal(spike);
  tree.root = tree.add_node(Op::Union, {cube, pin});
  CHECK(scored(tree).hausdorff == doctest::Approx(0.5 / std::sqrt(300.0)).epsilon(0.1));
}

TEST_CASE("the number of threads leaves no trace in the score") {
  const TreeScore one = scored(cube_tree(12), 1);
  const TreeScore four = scored(cube_tree(12), 4);
  CHECK(one.iou == four.iou);
  CHECK(one.mean_distance == four.mean_distance);
  CHECK(one.hausdorff == four.hausdorff);
}

}  // namespace
}  // namespace hewn
