#include "core/synth/inflate.h"

#include <doctest/doctest.h>

#include "core/synth/optimise.h"
#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

/// A random tree without redundant literals by chance: what the optimiser leaves of it.
Tree small_tree(Rng& rng) {
  testing::TreeShape shape;
  shape.depth = 3;
  const auto result = optimise(testing::random_tree(rng, shape), {}, {});
  REQUIRE(result.has_value());
  return result->tree;
}

TEST_CASE("an inflated tree is larger and the same solid") {
  Rng rng(31);
  for (int i = 0; i < 60; ++i) {
    const Tree tree = testing::random_tree(rng, {});
    RunContext run;
    run.seed = static_cast<std::uint64_t>(i);
    InflateOptions options;
    options.iterations = 4;
    const auto larger = inflate(tree, options, run);
    REQUIRE(larger.has_value());
    CHECK(tree_size(*larger) > tree_size(tree));
    for (int k = 0; k < 100; ++k) {
      const Vec3 x = testing::random_point(rng, 3);
      REQUIRE(tree.contains(x) == larger->contains(x));
    }
  }
}

TEST_CASE("each strategy works alone and the size is bounded") {
  Rng rng(32);
  Tree tree;
  const int a = tree.add_literal(testing::random_literal(rng));
  const int b = tree.add_literal(testing::random_literal(rng));
  const int c = tree.add_literal(testing::random_literal(rng));
  tree.root = tree.add_node(Op::Intersection, {a, tree.add_node(Op::Union, {b, c})});
  const auto size_with = [&](InflateOptions options) {
    options.iterations = 1;
    const auto larger = inflate(tree, options, {});
    REQUIRE(larger.has_value());
    return tree_size(*larger);
  };
  CHECK(size_with({1, 0, 0, 0, 0, 0}) == 5);
  CHECK(size_with({1, 0, 1, 0, 0, 0}) == 7);
  CHECK(size_with({1, 0, 0, 1, 0, 0}) == 7);
  CHECK(size_with({1, 1, 0, 0, 0, 0}) > 5);
  CHECK(size_with({1, 0, 0, 0, 1, 0}) > 7);
  CHECK(size_with({1, 0, 0, 0, 0, 1}) > 5);
  InflateOptions many;
  many.iterations = 50;
  many.most_nodes = 60;
  const auto bounded = inflate(tree, many, {});
  REQUIRE(bounded.has_value());
  CHECK(tree_size(*bounded) <= 60);
  CHECK(tree_size(*bounded) > 40);
  InflateOptions odd;
  odd.absorption = 2;
  CHECK_FALSE(inflate(tree, odd, {}).has_value());
}

TEST_CASE("the optimiser takes inflated trees back to their size") {
  Rng rng(33);
  int back = 0;
  constexpr int kTrees = 30;
  for (int i = 0; i < kTrees; ++i) {
    const Tree tree = small_tree(rng);
    RunContext run;
    run.seed = static_cast<std::uint64_t>(i);
    const auto larger = inflate(tree, {}, run);
    REQUIRE(larger.has_value());
    const auto result = optimise(*larger, {}, {});
    REQUIRE(result.has_value());
    if (result->after.size <= tree_size(tree)) ++back;
  }
  CHECK(back >= kTrees - 1);
}

}  // namespace
}  // namespace hewn
