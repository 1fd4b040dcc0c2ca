#include <doctest/doctest.h>

#include "random_tree.h"

namespace hewn {
namespace {

bool has_complement(const Tree& tree) {
  for (const Node& node : tree.nodes) {
    if (node.op == Op::Complement) return true;
  }
  return false;
}

std::vector<std::string> names(const Tree& tree) {
  std::vector<std::string> result;
  for (const Node& node : tree.nodes) {
    if (!node.name.empty()) result.push_back(node.name);
  }
  return result;
}

TEST_CASE("flattening keeps the solid, the literals and the names of random trees") {
  Rng rng(41);
  for (int i = 0; i < 300; ++i) {
    const Tree tree = testing::random_tree(rng, {.has_complements = true, .has_names = true});
    const Tree flat = flattened(tree);
    CHECK(literal_count(flat) == literal_count(tree));
    CHECK(flat.literals.size() == static_cast<std::size_t>(literal_count(flat)));
    CHECK(tree_size(flat) <= tree_size(tree));
    CHECK(names(flat).size() == names(tree).size());
    for (int k = 0; k < 50; ++k) {
      const Vec3 x = testing::random_point(rng, 2);
      CHECK(flat.contains(x) == tree.contains(x));
    }
  }
}

TEST_CASE("nested operations of one kind become one node") {
  Rng rng(42);
  Tree tree;
  const auto leaf = [&] { return tree.add_literal(testing::random_literal(rng)); };
  const int ab = tree.add_node(Op::Union, {leaf(), leaf()});
  const int cd = tree.add_node(Op::Union, {leaf(), leaf()});
  const int base = tree.add_node(Op::Union, {ab, cd});
  const int cut = tree.add_node(Op::Difference, {base, leaf()});
  const int tools = tree.add_node(Op::Union, {leaf(), leaf()});
  tree.root = tree.add_node(Op::Difference, {cut, tools});
  const Tree flat = flattened(tree);
  const Node& root = flat.nodes[flat.root];
  CHECK(root.op == Op::Difference);
  CHECK(root.children.size() == 4);
  CHECK(flat.nodes[root.children[0]].children.size() == 4);
}

TEST_CASE("a named operand is not merged into its parent") {
  Rng rng(43);
  Tree tree;
  const auto leaf = [&] { return tree.add_literal(testing::random_literal(rng)); };
  const int named = tree.add_node(Op::Union, {leaf(), leaf()}, "boss");
  tree.root = tree.add_node(Op::Union, {named, leaf()});
  const Tree flat = flattened(tree);
  CHECK(flat.nodes[flat.root].children.size() == 2);
  CHECK(names(flat) == std::vector<std::string>{"boss"});
}

TEST_CASE("operations without operands vanish") {
  Rng rng(44);
  Tree tree;
  const int a = tree.add_literal(testing::random_literal(rng));
  const int nothing = tree.add_node(Op::Union, {});
  tree.root = tree.add_node(Op::Difference, {a, nothing});
  CHECK(tree_size(flattened(tree)) == 1);
  tree.root = tree.add_node(Op::Intersection, {a, nothing});
  CHECK(flattened(tree).is_empty());
  tree.root = tree.add_node(Op::Difference, {nothing, a});
  CHECK(flattened(tree).is_empty());
}

TEST_CASE("complements can be removed from random trees") {
  Rng rng(45);
  for (int i = 0; i < 300; ++i) {
    const Tree tree = testing::random_tree(rng, {.has_complements = true, .has_names = true});
    const Tree plain = without_complements(tree);
    CHECK_FALSE(has_complement(plain));
    CHECK(literal_count(plain) <= literal_count(tree) + 1);
    // Beyond the literals an unbounded solid is cut off.
    const Box3 box = tree.literals[rng.below(tree.literals.size())].bounds();
    for (int k = 0; k < 50; ++k) {
      const Vec3 x = box.center() + testing::random_point(rng, 0.5).cwiseProduct(box.size());
      CHECK(plain.contains(x) == tree.contains(x));
    }
  }
}

}  // namespace
}  // namespace hewn
