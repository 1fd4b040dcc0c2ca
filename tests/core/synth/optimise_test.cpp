#include "core/synth/optimise.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "tests/core/csg/box.h"
#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

using testing::box;
using testing::random_point;

Literal ball(double radius) {
  Literal s;
  s.kind = SolidKind::Sphere;
  s.radius = radius;
  return s;
}

/// Points nearer to a surface than this are not compared: rounding may decide them.
constexpr double kSkin = 1e-5;

bool is_near_surface(const Tree& tree, const Vec3& x) {
  for (const Literal& s : tree.literals) {
    if (std::abs(s.signed_distance(x)) < kSkin) return true;
  }
  return false;
}

void check_same(const Tree& a, const Tree& b, Rng& rng, int points) {
  for (int i = 0; i < points; ++i) {
    const Vec3 x = random_point(rng, 3);
    if (is_near_surface(a, x)) continue;
    REQUIRE(a.contains(x) == b.contains(x));
  }
}

OptimiseResult optimised(const Tree& tree, const OptimiseOptions& options = {}) {
  const auto result = optimise(tree, options, {});
  REQUIRE(result.has_value());
  return *result;
}

Literal rod(double radius, double from, double to) {
  Literal s;
  s.kind = SolidKind::Cylinder;
  s.radius = s.top_radius = radius;
  s.origin.z() = from;
  s.height = to - from;
  return s;
}

TEST_CASE("random trees keep their solid and never grow, whatever the method") {
  Rng rng(21);
  testing::TreeShape shape;
  shape.depth = 3;
  shape.has_complements = true;
  OptimiseOptions options;
  options.equivalence.points = 5'000;
  options.equivalence.smallest_cell = 1.0 / 16;
  options.remaining.genetic.iterations = 40;
  options.remaining.genetic.population = 40;
  constexpr OptimiseMethod kOthers[] = {OptimiseMethod::Redundancy,     OptimiseMethod::Dominant,
                                        OptimiseMethod::QuineMcCluskey, OptimiseMethod::Espresso,
                                        OptimiseMethod::SetCover,       OptimiseMethod::Annealing,
                                        OptimiseMethod::Genetic};
  int smaller = 0;
  for (int i = 0; i < 500; ++i) {
    const Tree tree = testing::random_tree(rng, shape);
    options.method = i % 2 == 0 ? OptimiseMethod::Rewrite : kOthers[i / 2 % std::size(kOthers)];
    options.rebuilds = i % 4 == 0;  // takes most of the time
    CAPTURE(i);
    const auto optimum = optimise(tree, options, {});
    // Quine-McCluskey takes no more than 16 primitives.
    if (!optimum && optimum.error().code == ErrorCode::TooLarge) continue;
    REQUIRE(optimum.has_value());
    const OptimiseResult& result = *optimum;
    REQUIRE(result.after.size <= result.before.size);
    REQUIRE(tree_size(result.tree) == result.after.size);
    check_same(tree, result.tree, rng, 200);
    smaller += result.after.size < result.before.size ? 1 : 0;
  }
  CHECK(smaller > 100);
}

TEST_CASE("wherever the search starts, the solid stays") {
  Rng rng(22);
  testing::TreeShape shape;
  shape.depth = 3;
  OptimiseOptions options;
  options.equivalence.points = 2'000;
  options.equivalence.smallest_cell = 1.0 / 16;
  options.rebuilds = false;
  for (int i = 0; i < 16; ++i) {
    const Tree tree = testing::random_tree(rng, shape);
    options.method = i % 4 < 2 ? OptimiseMethod::Rewrite : OptimiseMethod::Dominant;
    for (const CellSampling cells : {CellSampling::Octree, CellSampling::Grid}) {
      options.cells = cells;
      CAPTURE(i);
      const OptimiseResult result = optimised(tree, options);
      REQUIRE(result.after.size <= result.before.size);
      check_same(tree, result.tree, rng, 200);
    }
  }
}

TEST_CASE("what the authors' program gets wrong") {
  const Literal a = box({0, 0, 0}, {2, 2, 2});
  const auto two = [](Op op, const Literal& l, const Literal& r) {
    Tree tree;
    const int left = tree.add_literal(l);
    const int right = tree.add_literal(r);
    tree.root = tree.add_node(op, {left, right});
    return tree;
  };
  CHECK(optimised(two(Op::Union, a, box({0.5, 0.5, 0.5}, {1, 1, 2}))).after.size == 1);
  CHECK(optimised(two(Op::Difference, a, box({3, 0, 0}, {4, 2, 2}))).after.size == 1);
  const OptimiseResult gone = optimised(two(Op::Difference, a, box({-1, -1, -1}, {3, 3, 3})));
  CHECK(gone.extent == SolidExtent::Empty);
  CHECK(gone.tree.is_empty());
  // A plate of 1e-3 of the diagonal stays.
  const OptimiseResult thin = optimised(two(Op::Union, a, box({0.5, 0.5, 2}, {1, 1, 2.0035})));
  CHECK(thin.after.size == 3);
  // A lone literal that does not dominate must not be united in.
  CHECK(optimised(two(Op::Intersection, a, ball(1))).after.size == 3);
}

TEST_CASE("a tree without literals stays as it is") {
  const OptimiseResult none = optimised(Tree{});
  CHECK(none.extent == SolidExtent::Empty);
  CHECK(none.after.size == 0);
  Tree everything;
  everything.root = everything.add_node(Op::Complement, {everything.add_node(Op::Union, {})});
  CHECK(optimised(everything).extent == SolidExtent::Everything);
}

TEST_CASE("an unbounded solid is everything or keeps its complement") {
  Tree tree;
  const int a = tree.add_literal(ball(1));
  const int b = tree.add_literal(ball(1));
  const int c = tree.add_node(Op::Complement, {b});
  tree.root = tree.add_node(Op::Union, {a, c});
  const OptimiseResult all = optimised(tree);
  CHECK(all.extent == SolidExtent::Everything);
  CHECK(all.tree.contains(Vec3(50, 0, 0)));
  tree.root = c;
  const OptimiseResult outside = optimised(tree);
  CHECK(outside.after.size == 2);
  CHECK_FALSE(outside.tree.contains(Vec3::Zero()));
}

TEST_CASE("a tolerance lets thin features go and says how many, thick ones stay") {
  Tree tree;
  const int block = tree.add_literal(box({0, 0, 0}, {2, 2, 2}));
  const int plate = tree.add_literal(box({0.5, 0.5, 2}, {1, 1, 2.003}));
  const int knob = tree.add_literal(box({0.2, 0.2, 2}, {0.4, 0.4, 2.1}));
  tree.root = tree.add_node(Op::Union, {block, plate, knob});
  CHECK(optimised(tree).after.literals == 3);
  OptimiseOptions options;
  options.tolerance = 0.002;
  const OptimiseResult result = optimised(tree, options);
  CHECK(result.after.literals == 2);
  CHECK(result.changed_cells == 1);
  REQUIRE(result.thin_features.size() == 1);
  // The plate went, or all of the block's top is as high as it.
  const ThinFeature& f = result.thin_features[0];
  CHECK(f.thickness < 0.0031);
  CHECK(f.at.z() > 2);
  CHECK(f.at.z() < 2.003);
  CHECK(f.is_filled == result.tree.contains(f.at));
  CHECK(result.tree.contains(Vec3(0.3, 0.3, 2.05)));
  CHECK(result.equivalence.different == 0);
  CHECK(result.equivalence.largest_distance <= 0.002 * 3.5);
}

TEST_CASE("the same seed gives the same tree for any number of threads") {
  Rng rng(8);
  const Tree tree = testing::random_tree(rng, {});
  RunContext one;
  one.threads = 1;
  RunContext three;
  three.threads = 3;
  const auto a = optimise(tree, {}, one);
  const auto b = optimise(tree, {}, three);
  REQUIRE(a.has_value());
  REQUIRE(b.has_value());
  CHECK(a->after.size == b->after.size);
  CHECK(a->cells == b->cells);
  CHECK(a->equivalence.points == b->equivalence.points);
  REQUIRE(a->tree.nodes.size() == b->tree.nodes.size());
  for (std::size_t i = 0; i < a->tree.nodes.size(); ++i) {
    CHECK(a->tree.nodes[i].op == b->tree.nodes[i].op);
    CHECK(a->tree.nodes[i].children == b->tree.nodes[i].children);
  }
}

TEST_CASE("optimising stops on request and refuses odd options") {
  Rng rng(8);
  const Tree tree = testing::random_tree(rng, {});
  RunContext run;
  run.cancel->cancel();
  const auto stopped = optimise(tree, {}, run);
  REQUIRE_FALSE(stopped.has_value());
  CHECK(stopped.error().code == ErrorCode::Cancelled);
  OptimiseOptions odd;
  odd.tolerance = std::nan("");
  const auto refused = optimise(tree, odd, {});
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().code == ErrorCode::InvalidArgument);
}

TEST_CASE("a pin that only touched its plate comes to overlap it") {
  Tree tree;
  const int plate = tree.add_literal(rod(2, 0, 1));
  const int bore = tree.add_literal(rod(1, -3, 3));
  const int pin = tree.add_literal(rod(1, -2, 0.5));
  const int ring = tree.add_node(Op::Difference, {plate, bore});
  tree.root = tree.add_node(Op::Union, {ring, pin});
  const OptimiseResult result = optimised(tree);
  CHECK(result.before.proximity == doctest::Approx(0.8));
  CHECK(result.after.proximity == doctest::Approx(1));
  CHECK(result.after.literals == 3);
  // The bore that is left begins at the pin and sticks out of the plate.
  const auto& literals = result.tree.literals;
  const auto cut = std::find_if(literals.begin(), literals.end(),
                                [](const Literal& s) { return s.origin.z() == 0.5; });
  REQUIRE(cut != literals.end());
  CHECK(cut->origin.z() + cut->height > 1);
}

}  // namespace
}  // namespace hewn
