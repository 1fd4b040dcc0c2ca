#include "core/session/result_view.h"

#include <doctest/doctest.h>

#include "tests/core/session/session_fixture.h"

namespace hewn {
namespace {

Literal box(const Vec3& origin, const Vec3& size) {
  Literal s;
  s.origin = origin;
  s.size = size;
  return s;
}

/// A block from which a tool is taken whose end is flush with another block's top.
Reconstruction flush_blocks() {
  Reconstruction found;
  found.prepared.mesh =
      std::make_shared<const Mesh>(solids::plate_with_hole(Vec3(40, 20, 8), 3, 16));
  found.prepared.query = std::make_shared<const MeshQuery>(found.prepared.mesh);
  Tree& tree = found.tree;
  // a less b leaves z < 2 of a; c stands on the left with its top at z = 2 as well.
  const int a = tree.add_literal(box({0, 0, 0}, {10, 10, 10}));
  const int b = tree.add_literal(box({-1, -1, 2}, {12, 12, 9}));
  const int c = tree.add_literal(box({-10, 0, 0}, {10, 10, 2}));
  const int cut = tree.add_node(Op::Difference, {a, b});
  tree.root = tree.add_node(Op::Union, {cut, c});
  return found;
}

TEST_CASE("coincident faces get the literal that makes them, not the first one nearby") {
  const Reconstruction found = flush_blocks();
  const auto view = build_result_view(found, testing::one_thread());
  REQUIRE(view);
  const DisplayMesh& surface = view->surface;
  int tops = 0;
  for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
    const DisplayCorner& corner = surface.corners[surface.indices[i]];
    if (corner.normal[2] < 0.9F) continue;
    ++tops;
    // The top is one flat face; by area the tool's part and the block's are equal, and a's own
    // faces have none of it.
    CHECK(corner.label != 0);
  }
  CHECK(tops > 0);
}

TEST_CASE("a view holds the tree's program, or says why not") {
  Reconstruction found = flush_blocks();
  auto view = build_result_view(found, testing::one_thread());
  REQUIRE(view);
  REQUIRE(view->program);
  CHECK(view->program->steps.size() == 3);
  CHECK(view->program_problem.empty());

  found.tree = {};
  found.tree.root = found.tree.add_literal(polyhedron_literal(found.prepared.mesh));
  view = build_result_view(found, testing::one_thread());
  REQUIRE(view);
  CHECK_FALSE(view->program);
  CHECK(view->program_problem == "it holds a polyhedron");
}

}  // namespace
}  // namespace hewn
