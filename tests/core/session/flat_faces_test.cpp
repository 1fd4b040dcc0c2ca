#include "core/session/flat_faces.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "tests/core/csg/box.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

TEST_CASE("a flat face takes the label of most of its area") {
  const Mesh mesh = solids::box({0, 0, 0}, {3, 2, 1}, 2);
  std::vector<int> labels(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < labels.size(); ++t) {
    if (mesh.normals[t].z() > 0.5 && mesh.centroid(static_cast<int>(t)).x() < 1) labels[t] = 1;
  }
  const std::vector<FlatFace> faces = unify_flat_faces(mesh, labels);
  REQUIRE(faces.size() == 6);
  double area = 0;
  for (const FlatFace& face : faces) {
    CHECK(face.label == 0);
    area += face.area;
  }
  CHECK(area == doctest::Approx(22));
  CHECK(std::count(labels.begin(), labels.end(), 1) == 0);
}

TEST_CASE("flush ends are shown as one literal, ends elsewhere as their own") {
  // A block, a second one that goes on from it, and a tool that cuts the second one down.
  Tree tree;
  const int left = tree.add_literal(testing::box({0, 0, 0}, {4, 2, 1}));
  const int right = tree.add_literal(testing::box({4, 0, 0}, {6, 2, 2}));
  const int tool = tree.add_literal(testing::box({4, -1, 1}, {7, 3, 3}));
  const int both = tree.add_node(Op::Union, {left, right});
  tree.root = tree.add_node(Op::Difference, {both, tool});
  const Mesh mesh = solids::box({0, 0, 0}, {6, 2, 1});
  std::vector<int> labels;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    labels.push_back(mesh.normals[t].x() > 0.5 ? 1 : 0);
  }
  const auto shown = shown_labels(tree, unify_flat_faces(mesh, labels), 1e-6);
  REQUIRE(shown.size() == 18);
  const std::vector<std::int32_t> of_left(shown.begin(), shown.begin() + 6);
  const std::vector<std::int32_t> of_right(shown.begin() + 6, shown.begin() + 12);
  const std::vector<std::int32_t> of_tool(shown.begin() + 12, shown.end());
  CHECK(of_left == std::vector<std::int32_t>{0, 0, 0, 0, 0, 0});
  CHECK(of_right == std::vector<std::int32_t>{1, 1, 0, 0, 0, 1});
  CHECK(of_tool == std::vector<std::int32_t>{2, 2, 2, 2, 0, 2});
}

}  // namespace
}  // namespace hewn
