#include "core/sample/sample_table.h"

#include <doctest/doctest.h>

#include "tests/support/part_problem.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

constexpr int kPoints = 4000;

TEST_CASE("every sample of a plate with a hole has the label of the true solid") {
  const solids::PartProblem part(solids::plate_with_hole({10, 8, 2}, 2, 48));
  const auto table =
      build_sample_table(part.space, kPoints, part.surfaces.halfspace_of_group, part.run);
  REQUIRE(table.has_value());
  REQUIRE(table->size() > kPoints / 2);
  int wrong = 0;
  for (std::size_t i = 0; i < table->size(); ++i) {
    const Vec3& p = table->points[i];
    const bool in_plate = std::abs(p.x()) < 5 && std::abs(p.y()) < 4 && std::abs(p.z()) < 1;
    const bool in_hole = std::hypot(p.x(), p.y()) < 2;
    wrong += (in_plate && !in_hole) == (table->is_inside[i] != 0) ? 0 : 1;
  }
  CHECK(wrong == 0);
}

TEST_CASE("no sample lies within the tolerance of a surface, and pairs straddle their group") {
  const solids::PartProblem part(solids::cylinder(3, 5, 36));
  const auto table =
      build_sample_table(part.space, kPoints, part.surfaces.halfspace_of_group, part.run);
  REQUIRE(table.has_value());
  for (const Vec3& p : table->points) CHECK(is_certain(part.space, p));
  REQUIRE(!table->pairs.empty());
  for (const SamplePair& pair : table->pairs) {
    CHECK(table->is_inside[pair.inside] == 1);
    CHECK(table->is_inside[pair.outside] == 0);
  }
}

TEST_CASE("the table is the same for any number of threads") {
  solids::PartProblem part(solids::block_with_fillet({6, 5, 4}, 1.5, 12));
  part.run.threads = 1;
  const auto one =
      build_sample_table(part.space, kPoints, part.surfaces.halfspace_of_group, part.run);
  part.run.threads = 4;
  const auto four =
      build_sample_table(part.space, kPoints, part.surfaces.halfspace_of_group, part.run);
  REQUIRE(one.has_value());
  REQUIRE(four.has_value());
  CHECK(one->points == four->points);
  CHECK(one->is_inside == four->is_inside);
  CHECK(one->signatures == four->signatures);
}

TEST_CASE("halfspaces appended later give the signatures that they would have given at first") {
  const solids::PartProblem part(solids::plate_with_hole({10, 8, 2}, 2, 24));
  auto table = build_sample_table(part.space, kPoints, part.surfaces.halfspace_of_group, part.run);
  REQUIRE(table.has_value());
  std::vector<Halfspace> more = part.surfaces.halfspaces;
  for (int k = 0; k < 70; ++k) {  // crosses a word boundary
    Halfspace h;
    h.surface.axis = Vec3::UnitX();
    h.surface.offset = -5 + 0.1 * k;
    more.push_back(h);
  }
  append_halfspaces(*table, more, part.run);
  for (std::size_t i = 0; i < table->size(); i += 37) {
    for (std::size_t k = 0; k < more.size(); ++k) {
      CHECK(test_bit(table->signature(i), k) ==
            (more[k].surface.signed_distance(table->points[i]) < 0));
    }
  }
}

TEST_CASE("a cancelled run stops sampling") {
  solids::PartProblem part(solids::cylinder(3, 5, 36));
  part.run.cancel->cancel();
  const auto table =
      build_sample_table(part.space, kPoints, part.surfaces.halfspace_of_group, part.run);
  REQUIRE(!table.has_value());
  CHECK(table.error().code == ErrorCode::Cancelled);
}

}  // namespace
}  // namespace hewn
