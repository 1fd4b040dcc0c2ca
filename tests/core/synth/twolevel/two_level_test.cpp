#include "core/synth/twolevel/two_level.h"

#include <doctest/doctest.h>

#include "core/synth/remaining_solid.h"
#include "core/synth/simplify/dominant.h"
#include "tests/core/synth/simplify/formula_fixture.h"

namespace hewn {
namespace {

using testing::all_cells;
using testing::random_column;
using testing::random_formula;
using testing::same_on;

/// A formula in which no literal dominates: a b + c d + !a !c (d + !b).
Formula tangled() {
  const auto leaf = [](int k, bool negated = false) { return Formula::leaf(k, negated); };
  const auto both = [](Formula::Kind kind, Formula a, Formula b) {
    std::vector<Formula> parts;
    parts.push_back(std::move(a));
    parts.push_back(std::move(b));
    return Formula::join(kind, std::move(parts));
  };
  using Kind = Formula::Kind;
  Formula last = both(Kind::And, both(Kind::And, leaf(0, true), leaf(2, true)),
                      both(Kind::Or, leaf(3), leaf(1, true)));
  return both(Kind::Or,
              both(Kind::Or, both(Kind::And, leaf(0), leaf(1)), both(Kind::And, leaf(2), leaf(3))),
              std::move(last));
}

TEST_CASE("every method rebuilds the same solid, with don't-cares") {
  Rng rng(41);
  const CellColumns cells = all_cells(6);
  for (int i = 0; i < 60; ++i) {
    const Formula f = i == 0 ? tangled() : normalised(random_formula(rng, 6, 4));
    const Column care = i % 2 == 0 ? cells.all() : random_column(rng, cells);
    for (const RemainingMethod method :
         {RemainingMethod::None, RemainingMethod::Rewrite, RemainingMethod::QuineMcCluskey,
          RemainingMethod::Espresso, RemainingMethod::SetCover, RemainingMethod::Annealing,
          RemainingMethod::Genetic}) {
      CAPTURE(static_cast<int>(method));
      RemainingOptions options;
      options.genetic.iterations = 30;
      const auto made = rebuild_remaining(method, f, cells, care, options, {});
      REQUIRE(made.has_value());
      REQUIRE(same_on(f, *made, cells, care));
    }
  }
}

TEST_CASE("Quine-McCluskey finds the least disjunctive form, the others come near") {
  Rng rng(42);
  const CellColumns cells = all_cells(5);
  int espresso_sum = 0;
  int least_sum = 0;
  for (int i = 0; i < 60; ++i) {
    const TwoLevelProblem problem =
        two_level_problem(normalised(random_formula(rng, 5, 4)), cells, cells.all());
    const auto cost = [&](const Result<std::vector<Cube>>& cubes) {
      REQUIRE(cubes.has_value());
      int n = 0;
      for (const Cube& c : *cubes) n += std::max(1, c.literals());
      return n;
    };
    const int least = cost(quine_mccluskey(problem, {}, {}));
    const int by_espresso = cost(espresso(problem, {}));
    const int by_cover = cost(set_cover(problem, false, {}, {}));
    const int by_annealing = cost(set_cover(problem, true, {}, {}));
    REQUIRE(least <= by_espresso);
    REQUIRE(least <= by_cover);
    REQUIRE(by_cover <= by_annealing);
    espresso_sum += by_espresso;
    least_sum += least;
  }
  CHECK(espresso_sum <= 1.15 * least_sum);
}

TEST_CASE("a known minimum") {
  // x0 x1 + !x0 x2 + x1 x2: the last term is the consensus of the others.
  const CellColumns cells = all_cells(3);
  std::vector<Formula> terms;
  const auto add = [&terms](Formula a, Formula b) {
    std::vector<Formula> sides;
    sides.push_back(std::move(a));
    sides.push_back(std::move(b));
    terms.push_back(Formula::join(Formula::Kind::And, std::move(sides)));
  };
  add(Formula::leaf(0), Formula::leaf(1));
  add(Formula::leaf(0, true), Formula::leaf(2));
  add(Formula::leaf(1), Formula::leaf(2));
  const TwoLevelProblem problem = two_level_problem(
      normalised(Formula::join(Formula::Kind::Or, std::move(terms))), cells, cells.all());
  const auto cubes = quine_mccluskey(problem, {}, {});
  REQUIRE(cubes.has_value());
  CHECK(cubes->size() == 2);
  const auto by_espresso = espresso(problem, {});
  REQUIRE(by_espresso.has_value());
  CHECK(by_espresso->size() == 2);
}

TEST_CASE("Quine-McCluskey refuses what its tables cannot hold") {
  Formula f = Formula::leaf(0);
  for (int k = 1; k < 14; ++k) {
    std::vector<Formula> parts;
    parts.push_back(std::move(f));
    parts.push_back(Formula::leaf(k));
    f = Formula::join(k % 2 ? Formula::Kind::Or : Formula::Kind::And, std::move(parts));
  }
  const CellColumns cells = all_cells(14);
  const auto refused = quine_mccluskey(two_level_problem(f, cells, cells.all()), {}, {});
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().code == ErrorCode::TooLarge);
}

TEST_CASE("decomposition peels what dominates, and nothing is left of a chain") {
  Rng rng(43);
  const CellColumns cells = all_cells(6);
  Formula chain = Formula::leaf(0);
  for (int k = 1; k < 6; ++k) {
    std::vector<Formula> parts;
    parts.push_back(std::move(chain));
    parts.push_back(Formula::leaf(k, k % 3 == 0));
    chain = Formula::join(k % 2 ? Formula::Kind::Or : Formula::Kind::And, std::move(parts));
  }
  const Decomposition whole = decompose(chain, cells, cells.all(), {});
  CHECK(whole.steps.size() == 5);
  CHECK(leaf_count(whole.rest) == 1);
  CHECK(same_on(chain, recomposed(whole, whole.rest), cells, cells.all()));
  CHECK(decompose(tangled(), cells, cells.all(), {}).steps.empty());
  for (int i = 0; i < 200; ++i) {
    const Formula f = normalised(random_formula(rng, 6, 4));
    const Decomposition d = decompose(f, cells, cells.all(), {});
    REQUIRE(same_on(f, recomposed(d, d.rest), cells, cells.all()));
  }
}

}  // namespace
}  // namespace hewn
