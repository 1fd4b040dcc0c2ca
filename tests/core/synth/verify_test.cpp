#include "core/synth/verify.h"

#include "tests/core/synth/search_fixture.h"

namespace hewn {
namespace {

bool in_plate(const Vec3& p) {
  return std::abs(p.x()) < 5 && std::abs(p.y()) < 4 && std::abs(p.z()) < 1;
}

TEST_CASE("the true solid has full agreement and no counterexample") {
  const SearchFixture f(solids::plate_with_hole({10, 8, 2}, 2, 48));
  const auto truth = [](const Vec3& p) { return in_plate(p) && std::hypot(p.x(), p.y()) >= 2; };
  const Verification v = verify_list(f.part.space, {}, truth, {}, 1, f.part.run);
  CHECK(v.agreement == 1);
  CHECK(v.counterexamples.empty());
}

TEST_CASE("a forgotten hole shows in the agreement and in the counterexamples") {
  const SearchFixture f(solids::plate_with_hole({10, 8, 2}, 2, 48));
  const Verification v = verify_list(f.part.space, {}, in_plate, {}, 1, f.part.run);
  CHECK(v.agreement == doctest::Approx(1 - 4 * kPi / 80).epsilon(0.02));
  REQUIRE(!v.counterexamples.empty());
  for (const LabelledPoint& p : v.counterexamples) {
    CHECK(!p.is_inside);
    CHECK(std::hypot(p.position.x(), p.position.y()) < 2);
  }
}

}  // namespace
}  // namespace hewn
