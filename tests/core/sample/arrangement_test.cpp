#include "core/sample/arrangement.h"

#include <doctest/doctest.h>

#include "tests/core/csg/box.h"
#include "tests/core/csg/random_tree.h"

namespace hewn {
namespace {

using testing::box;

Arrangement cells_of(std::vector<Literal> literals, double scale) {
  ArrangementSampler sampler(std::move(literals), scale);
  const auto added = sampler.sample({}, {});
  REQUIRE(added.has_value());
  CHECK(*added == sampler.arrangement().size());
  return sampler.arrangement();
}

bool has_cell(const Arrangement& a, Word signature) {
  for (std::size_t c = 0; c < a.size(); ++c) {
    if (a.signature(c)[0] == signature) return true;
  }
  return false;
}

TEST_CASE("two overlapping boxes have four cells") {
  const Arrangement a = cells_of({box({0, 0, 0}, {2, 2, 2}), box({1, 1, 1}, {3, 3, 3})}, 5);
  CHECK(a.size() == 4);
  for (Word signature = 0; signature < 4; ++signature) CHECK(has_cell(a, signature));
}

TEST_CASE("boxes that touch have no common cell") {
  const Arrangement a = cells_of({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1})}, 2);
  CHECK(a.size() == 3);
  CHECK_FALSE(has_cell(a, 3));
}

TEST_CASE("thin plates, slits and corners are not lost") {
  for (const double t : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const Literal block = box({0, 0, 0}, {1, 1, 1});
    CHECK(has_cell(cells_of({block, box({0.2, 0.2, 1 - t}, {0.4, 0.4, 2})}, 1.7), 3));
    CHECK(has_cell(cells_of({block, box({0, 0, t}, {1, 1, 1})}, 1.7), 1));
    CHECK(has_cell(cells_of({block, box({1 - t, 1 - t, -1}, {2, 2, 2})}, 1.7), 3));
    Literal ball;
    ball.kind = SolidKind::Sphere;
    ball.radius = 0.5;
    ball.origin = Vec3(1.5 - t, 0.5, 0.5);
    CHECK(has_cell(cells_of({block, ball}, 1.7), 3));
  }
}

TEST_CASE("every cell's point shows its signature") {
  Rng rng(4);
  for (int i = 0; i < 10; ++i) {
    std::vector<Literal> literals;
    for (int k = 0; k < 8; ++k) literals.push_back(testing::random_literal(rng));
    const Arrangement a = cells_of(literals, 4);
    for (std::size_t c = 0; c < a.size(); ++c) {
      for (int k = 0; k < 8; ++k) {
        const bool inside = literals[k].signed_distance(a.points[c]) < 0;
        REQUIRE(inside == a.is_inside(c, k));
      }
    }
  }
}

TEST_CASE("lines find nearly all cells that a million random points find") {
  Rng rng(9);
  std::vector<Literal> literals;
  for (int k = 0; k < 10; ++k) literals.push_back(testing::random_literal(rng));
  ArrangementSampler sampler(literals, 4);
  REQUIRE(sampler.sample({}, {}).has_value());
  const std::size_t by_lines = sampler.arrangement().size();
  std::vector<Vec3> points;
  for (int i = 0; i < 300'000; ++i) points.push_back(testing::random_point(rng, 3));
  const std::size_t missed = sampler.add(points, {});
  CHECK(static_cast<double>(missed) <= 0.01 * static_cast<double>(by_lines));
}

TEST_CASE("the cells do not depend on the number of threads") {
  Rng rng(6);
  std::vector<Literal> literals;
  for (int k = 0; k < 6; ++k) literals.push_back(testing::random_literal(rng));
  RunContext one;
  one.threads = 1;
  RunContext four;
  four.threads = 4;
  ArrangementSampler a(literals, 4);
  ArrangementSampler b(literals, 4);
  REQUIRE(a.sample({}, one).has_value());
  REQUIRE(b.sample({}, four).has_value());
  CHECK(a.arrangement().signatures == b.arrangement().signatures);
  CHECK(a.arrangement().points == b.arrangement().points);
}

TEST_CASE("known cells are not found again, unknown ones wherever sampling starts from") {
  Rng rng(12);
  std::vector<Literal> literals;
  for (int k = 0; k < 6; ++k) literals.push_back(testing::random_literal(rng));
  ArrangementSampler lines(literals, 4);
  REQUIRE(lines.sample({}, {}).has_value());
  const Arrangement all = lines.arrangement();
  ArrangementOptions fresh;
  fresh.stream = 1;
  const auto again = lines.sample(fresh, {});
  REQUIRE(again.has_value());
  CHECK(static_cast<double>(*again) <= 0.02 * static_cast<double>(all.size()));
  // Every second cell is given: the lines find the others.
  ArrangementSampler rest(literals, 4);
  std::vector<Vec3> given;
  for (std::size_t c = 0; c < all.size(); c += 2) given.push_back(all.points[c]);
  CHECK(rest.add(given, {}) == given.size());
  REQUIRE(rest.sample({}, {}).has_value());
  std::size_t missed = 0;
  for (const Vec3& p : all.points) missed += rest.cell_of(p) == rest.arrangement().size() ? 1 : 0;
  CHECK(static_cast<double>(missed) <= 0.02 * static_cast<double>(all.size()));
}

TEST_CASE("cells of an arrangement over other literals come over as their points do") {
  Rng rng(14);
  std::vector<Literal> some;
  for (int k = 0; k < 70; ++k) some.push_back(testing::random_literal(rng));
  std::vector<Literal> others;
  for (int k = 0; k < 9; ++k) others.push_back(testing::random_literal(rng));
  others.insert(others.begin() + 4, some.rbegin(), some.rbegin() + 60);
  ArrangementOptions few;
  few.volume_lines = 100;
  few.lines_per_face = few.curves_per_face = 1;
  few.crossing_lines = 100;
  ArrangementSampler known(some, 4);
  REQUIRE(known.sample(few, {}).has_value());
  ArrangementSampler by_points(others, 4);
  ArrangementSampler by_cells(others, 4);
  const std::size_t added = by_points.add(known.arrangement().points, {});
  CHECK(added > 100);
  CHECK(by_cells.add(known.arrangement(), {}) == added);
  CHECK(by_cells.arrangement().points == by_points.arrangement().points);
  CHECK(by_cells.arrangement().signatures == by_points.arrangement().signatures);
}

TEST_CASE("sampling stops on request") {
  ArrangementSampler sampler({box({0, 0, 0}, {1, 1, 1})}, 1);
  RunContext run;
  run.cancel->cancel();
  const auto done = sampler.sample({}, run);
  REQUIRE_FALSE(done.has_value());
  CHECK(done.error().code == ErrorCode::Cancelled);
}

}  // namespace
}  // namespace hewn
