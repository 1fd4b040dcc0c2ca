#include "ui/view/exact_choice.h"

#include <doctest/doctest.h>

namespace hewn {
namespace {

const ExactSituation kRest{.is_possible = true};
const ExactSituation kMoving{.is_possible = true, .is_hurried = true, .is_rough = true};

TEST_CASE("what cannot be drawn exactly never is") {
  CHECK_FALSE(draws_exactly(ExactMode::On, {}, {}));
  CHECK_FALSE(draws_exactly(ExactMode::Auto, {}, {1, 1}));
}

TEST_CASE("the user's word counts, whatever it costs") {
  const ExactCost dear{5000, 20000};
  CHECK(draws_exactly(ExactMode::On, kMoving, dear));
  CHECK_FALSE(draws_exactly(ExactMode::Off, kRest, {1, 1}));
}

TEST_CASE("what nothing is known of is tried in small first, at rest, once") {
  CHECK(needs_trial(ExactMode::Auto, kRest, {}));
  CHECK_FALSE(draws_exactly(ExactMode::Auto, kRest, {}));
  CHECK_FALSE(needs_trial(ExactMode::Auto, kMoving, {}));
  CHECK_FALSE(needs_trial(ExactMode::Auto, {}, {}));
  CHECK_FALSE(needs_trial(ExactMode::Auto, kRest, {5, -1}));
  CHECK_FALSE(needs_trial(ExactMode::On, kRest, {}));
}

TEST_CASE("the measured time decides from then on") {
  CHECK(draws_exactly(ExactMode::Auto, kRest, {-1, kRestingExact_ms - 1}));
  CHECK_FALSE(draws_exactly(ExactMode::Auto, kRest, {-1, kRestingExact_ms + 1}));
  CHECK(draws_exactly(ExactMode::Auto, kMoving, {kMovingExact_ms - 1, 4 * kMovingExact_ms}));
  CHECK_FALSE(draws_exactly(ExactMode::Auto, kMoving, {kMovingExact_ms + 1, 1}));
}

TEST_CASE("a quarter of the samples is expected to cost a quarter") {
  CHECK(draws_exactly(ExactMode::Auto, kMoving, {-1, 3.9 * kMovingExact_ms}));
  CHECK_FALSE(draws_exactly(ExactMode::Auto, kMoving, {-1, 4.1 * kMovingExact_ms}));
  CHECK_FALSE(draws_exactly(ExactMode::Auto, kRest, {kRestingExact_ms / 3, -1}));
}

TEST_CASE("the caption says how the result is drawn and why") {
  CHECK(exact_text(ExactMode::Auto, true, {-1, 38.4}, "") == "Exact, 38 ms");
  CHECK(exact_text(ExactMode::Auto, false, {-1, 900}, "") == "Triangles for now (exact: 900 ms)");
  CHECK(exact_text(ExactMode::Off, false, {-1, 900}, "") == "Triangles");
  CHECK(exact_text(ExactMode::On, false, {}, "it holds a polyhedron") ==
        "Triangles: it holds a polyhedron");
}

}  // namespace
}  // namespace hewn
