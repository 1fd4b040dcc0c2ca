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
  const Verification v = verify_list(f.part.space, {{}, truth, {}}, {}, 1, f.part.run);
  CHECK(v.agreement == 1);
  CHECK(v.counterexamples.empty());
}

TEST_CASE("a forgotten hole shows in the agreement and in the counterexamples") {
  const SearchFixture f(solids::plate_with_hole({10, 8, 2}, 2, 48));
  const Verification v = verify_list(f.part.space, {{}, in_plate, {}}, {}, 1, f.part.run);
  CHECK(v.agreement == doctest::Approx(1 - 4 * kPi / 80).epsilon(0.02));
  REQUIRE(!v.counterexamples.empty());
  for (const LabelledPoint& p : v.counterexamples) {
    CHECK(!p.is_inside);
    CHECK(std::hypot(p.position.x(), p.position.y()) < 2);
  }
}

TEST_CASE("lines through the tree find a slot too thin for the other points") {
  const SearchFixture f(solids::plate_with_hole({10, 8, 2}, 2, 48));
  const auto in_slot = [](const Vec3& p) {
    return p.x() > 3 && p.x() < 4.5 && p.y() > -3 && p.y() < 3 && std::abs(p.z()) < 2e-4;
  };
  const SolidTest slotted = [&](const Vec3& p) {
    return in_plate(p) && std::hypot(p.x(), p.y()) >= 2 && !in_slot(p);
  };
  Tree tree;
  Literal plate;
  plate.origin = Vec3(-5, -4, -1);
  plate.size = Vec3(10, 8, 2);
  Literal slot;
  slot.origin = Vec3(3, -3, -2e-4);
  slot.size = Vec3(1.5, 6, 4e-4);
  const int base = tree.add_literal(plate);
  const int cut = tree.add_literal(slot);
  tree.root = tree.add_node(Op::Difference, {base, cut});
  VerifyOptions options;
  options.uniform_points = options.near_points = options.around_points = 0;
  const DecisionList none;
  const Verification v = verify_list(f.part.space, {none, slotted, tree}, options, 1, f.part.run);
  CHECK(v.counterexamples.size() > 100);
  for (const LabelledPoint& p : v.counterexamples) CHECK(in_slot(p.position));
}

}  // namespace
}  // namespace hewn
