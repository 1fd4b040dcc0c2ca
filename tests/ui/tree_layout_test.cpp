#include "ui/view/tree_layout.h"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

GraphLayout laid_out(const Tree& tree, float width = 50) {
  return layout_tree(tree, std::vector<float>(tree.nodes.size(), width), {});
}

Tree chain(int depth) {
  Tree tree;
  tree.root = tree.add_literal({});
  for (int i = 0; i < depth; ++i) {
    tree.root = tree.add_node(Op::Difference, {tree.root, tree.add_literal({})});
  }
  return tree;
}

TEST_CASE("no two nodes of a graph overlap, and all lie within its size") {
  Rng rng(5);
  for (int i = 0; i < 60; ++i) {
    const Tree tree = testing::random_tree(rng, {.depth = 5});
    std::vector<float> widths;
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
      widths.push_back(static_cast<float>(rng.uniform(20, 120)));
    }
    const GraphSpacing spacing;
    const GraphLayout graph = layout_tree(tree, widths, spacing);
    for (std::size_t a = 0; a < graph.nodes.size(); ++a) {
      const GraphNode& n = graph.nodes[a];
      CHECK(n.x >= 0);
      CHECK(n.y >= 0);
      CHECK(n.x + n.width <= graph.width);
      CHECK(n.y + spacing.height <= graph.height);
      for (std::size_t b = a + 1; b < graph.nodes.size(); ++b) {
        const GraphNode& m = graph.nodes[b];
        const bool is_apart = n.x + n.width <= m.x || m.x + m.width <= n.x ||
                              std::abs(n.y - m.y) >= spacing.height + spacing.gap_y - 1e-3F;
        CHECK(is_apart);
      }
    }
  }
}

TEST_CASE("a parent stands amid its operands, left of them, and they keep their order") {
  Rng rng(6);
  for (int i = 0; i < 60; ++i) {
    const Tree tree = testing::random_tree(rng, {.depth = 5});
    const GraphLayout graph = laid_out(tree);
    std::vector<std::vector<const GraphNode*>> operands(graph.nodes.size());
    for (const GraphNode& node : graph.nodes) {
      if (node.parent < 0) continue;
      const GraphNode& parent = graph.nodes[node.parent];
      CHECK(parent.x + parent.width + GraphSpacing{}.gap_x <= node.x + 1e-3F);
      CHECK(tree.nodes[graph.nodes[node.parent].node].children[node.place] == node.node);
      operands[node.parent].push_back(&node);
    }
    for (std::size_t p = 0; p < operands.size(); ++p) {
      if (operands[p].empty()) continue;
      const float middle = (operands[p].front()->y + operands[p].back()->y) / 2;
      CHECK(graph.nodes[p].y == doctest::Approx(middle));
      for (std::size_t k = 1; k < operands[p].size(); ++k) {
        CHECK(operands[p][k]->y > operands[p][k - 1]->y);
      }
    }
  }
}

TEST_CASE("subtrees nestle: a bush beside a deep branch takes no rows of its own") {
  // Root: [leaf, chain, leaf]. The last leaf needs the room of one row below the chain's head only.
  Tree tree;
  const int first = tree.add_literal({});
  int deep = tree.add_literal({});
  for (int i = 0; i < 6; ++i) deep = tree.add_node(Op::Complement, {deep});
  const int last = tree.add_literal({});
  tree.root = tree.add_node(Op::Union, {first, deep, last});
  const GraphSpacing spacing;
  CHECK(laid_out(tree).height == doctest::Approx(3 * spacing.height + 2 * spacing.gap_y));
}

TEST_CASE("operands begin in the next free column; wide leaves push nobody away") {
  Tree tree;
  const int a = tree.add_literal({});
  const int b = tree.add_literal({});
  const int c = tree.add_literal({});
  const int inner = tree.add_node(Op::Difference, {a, b});
  tree.root = tree.add_node(Op::Union, {c, inner});
  const GraphSpacing spacing;
  const GraphLayout graph = layout_tree(tree, std::vector<float>{30, 30, 190, 20, 20}, spacing);
  CHECK(graph.nodes[0].node == tree.root);
  const auto x_of = [&graph](int node) {
    for (const GraphNode& n : graph.nodes) {
      if (n.node == node) return n.x;
    }
    return -1.0F;
  };
  CHECK(x_of(inner) == spacing.pitch);
  CHECK(x_of(a) == 2 * spacing.pitch);  // below the leaf of 190
  CHECK(x_of(c) == spacing.pitch);
  CHECK(graph.width == doctest::Approx(spacing.pitch + 190));
}

TEST_CASE("an empty tree has an empty graph; a chain of 200 is one step down a level") {
  CHECK(laid_out({}).nodes.empty());
  const GraphLayout graph = laid_out(chain(200));
  CHECK(graph.nodes.size() == 401);
  CHECK(graph.height < 201 * (GraphSpacing{}.height + GraphSpacing{}.gap_y) + 1);
}

}  // namespace
}  // namespace hewn
