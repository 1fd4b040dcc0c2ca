#include "core/synth/evolve/evolve_tree.h"

#include <doctest/doctest.h>

#include "core/synth/evolve/surface_fitness.h"
#include "tests/support/part_problem.h"
#include "tests/support/solids.h"

namespace hewn {
namespace {

BoundedPrimitive block(const Vec3& origin, const Vec3& size) {
  BoundedPrimitive p;
  p.literal.kind = SolidKind::Box;
  p.literal.origin = origin;
  p.literal.size = size;
  return p;
}

Result<TreeAnswer> evolve(const solids::PartProblem& part, const RunContext& run) {
  TreeProblem problem;
  problem.query = &part.query;
  problem.segmentation = &part.segmentation;
  problem.surfaces = &part.surfaces;
  return evolve_tree(problem, {}, run);
}

TreeAnswer evolved(const solids::PartProblem& part, std::uint64_t seed = 1) {
  RunContext run = part.run;
  run.seed = seed;
  auto answer = evolve(part, run);
  REQUIRE(answer.has_value());
  return *answer;
}

TEST_CASE("a surface fits the tree that it bounds, and no other as well") {
  // Two boxes side by side, the second one higher: their union and their difference.
  const std::vector<BoundedPrimitive> boxes = {block({0, 0, 0}, {4, 2, 2}),
                                               block({2, 0, 0}, {4, 2, 3})};
  const std::vector<SurfaceSample> of_union = {{{1, 1, 2}, Vec3::UnitZ()},
                                               {{4, 1, 3}, Vec3::UnitZ()},
                                               {{6, 1, 1}, Vec3::UnitX()},
                                               {{0, 1, 1}, -Vec3::UnitX()}};
  const std::vector<SurfaceSample> of_difference = {
      {{1, 1, 2}, Vec3::UnitZ()}, {{2, 1, 1}, Vec3::UnitX()}, {{0, 1, 1}, -Vec3::UnitX()}};
  const SurfaceReach reach{0.1, 0.2};
  const RunContext run;
  CpuDevice device(1);
  SurfaceFitness joined(boxes, of_union, reach, run);
  SurfaceFitness cut(boxes, of_difference, reach, run);
  const auto score = [&](SurfaceFitness& fitness, const Genome& genome) {
    TreeBatch batch;
    batch.add(genome);
    std::uint64_t total = 0;
    REQUIRE(fitness.scores().measure(device, batch, std::span(&total, 1), run).has_value());
    return static_cast<double>(total) / fitness.perfect_total();
  };
  const Genome both = {0, 1, kUnionToken};
  const Genome less = {0, 1, kDifferenceToken};
  const Genome common = {0, 1, kIntersectionToken};
  CHECK(score(joined, both) == doctest::Approx(1));
  CHECK(score(cut, less) == doctest::Approx(1));
  CHECK(score(joined, less) < 0.8);
  CHECK(score(joined, common) < 0.8);
  CHECK(score(cut, both) < 0.8);
  // Inside out, distances are as good and normals as bad as can be.
  CHECK(score(joined, {0, 1, kUnionToken, kComplementToken}) == doctest::Approx(0.5));
  // A difference is the intersection with the complement.
  CHECK(score(cut, {0, 1, kComplementToken, kIntersectionToken}) == doctest::Approx(1));
}

TEST_CASE("simple parts evolve into their trees") {
  const solids::PartProblem cylinder(solids::cylinder(2, 9, 32));
  CHECK(literal_count(evolved(cylinder).tree) == 1);
  const solids::PartProblem plate(solids::plate_with_hole({10, 8, 2}, 2, 32));
  const TreeAnswer answer = evolved(plate);
  CHECK(literal_count(answer.tree) <= 4);
  CHECK(answer.agreement > 0.999);
  CHECK(answer.evaluations > 0);
}

TEST_CASE("a seed gives the same tree for any number of threads") {
  solids::PartProblem part(solids::block_with_fillet({6, 5, 4}, 1.5, 12));
  part.run.threads = 1;
  const TreeAnswer one = evolved(part, 5);
  part.run.threads = 3;
  const TreeAnswer three = evolved(part, 5);
  CHECK(one.evaluations == three.evaluations);
  CHECK(one.agreement == three.agreement);
  REQUIRE(one.tree.literals.size() == three.tree.literals.size());
  for (std::size_t i = 0; i < one.tree.literals.size(); ++i) {
    CHECK(one.tree.literals[i].origin == three.tree.literals[i].origin);
  }
}

TEST_CASE("an evolution stops on request") {
  const solids::PartProblem part(solids::block_with_fillet({6, 5, 4}, 1.5, 12));
  RunContext run;
  run.cancel->cancel();
  const auto stopped = evolve(part, run);
  REQUIRE_FALSE(stopped.has_value());
  CHECK(stopped.error().code == ErrorCode::Cancelled);
}

}  // namespace
}  // namespace hewn
