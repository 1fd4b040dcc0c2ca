#include "core/sample/frame.h"

#include <doctest/doctest.h>

#include "tests/support/part_problem.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

TEST_CASE("an aligned part has the identity as its frame") {
  const solids::PartProblem part(solids::box({-1, -2, 0}, {4, 3, 7}));
  CHECK(part.space.frame.rotation == Mat3::Identity());
  CHECK(part.space.frame.box.lo == part.mesh->bounds.lo);
  CHECK(part.space.frame.box.hi == part.mesh->bounds.hi);
}

TEST_CASE("the frame of a turned box is the box's own, so that its volume is") {
  const Mesh turned =
      solids::transformed(solids::box({-1, -2, 0}, {4, 3, 7}), solids::oblique_transform());
  const solids::PartProblem part(turned);
  CHECK(part.space.frame.rotation.determinant() == doctest::Approx(1));
  CHECK(part.space.frame.box.size().prod() == doctest::Approx(5 * 5 * 7).epsilon(1e-6));
}

TEST_CASE("the frame of a lone cylinder contains its axis") {
  const solids::PartProblem part(solids::cylinder(2, 9, 32));
  const Frame& frame = part.space.frame;
  double along = 0;
  for (int c = 0; c < 3; ++c) along = std::max(along, std::abs(frame.rotation.col(c).z()));
  CHECK(along == doctest::Approx(1));
}

}  // namespace
}  // namespace hewn
