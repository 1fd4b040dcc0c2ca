#include "core/synth/evolve/genetic.h"

#include <doctest/doctest.h>

#include "core/compute/kernels/breeding.h"
#include "tests/core/synth/simplify/formula_fixture.h"
#include "tests/gpu/failing_device.h"

namespace hewn {
namespace {

using testing::all_cells;
using testing::random_formula;
using testing::same_on;

/// From the formula itself, which may not be a constant.
Result<GeneticResult> evolved_from(Formula f, const CellColumns& cells,
                                   const GeneticOptions& options, const RunContext& run) {
  evaluate(f, cells);
  return evolve({genome_of(f)}, cells, f.value, cells.all(), options, run);
}

TEST_CASE("a genome is the formula, and its parts are whole subtrees") {
  Rng rng(61);
  const CellColumns cells = all_cells(5);
  for (int i = 0; i < 300; ++i) {
    const Formula f = normalised(random_formula(rng, 5, 4));
    if (f.is_constant()) continue;
    const Genome genome = genome_of(f);
    REQUIRE(static_cast<int>(genome.size()) == formula_size(f));
    REQUIRE(same_on(f, formula_of(genome), cells, cells.all()));
    CHECK(subtree_begin(genome.data(), static_cast<std::int32_t>(genome.size()) - 1) == 0);
  }
  for (int i = 0; i < 200; ++i) {
    const Genome genome = random_genome(4, 21, rng);
    CHECK(genome.size() <= 21);
    CHECK(subtree_begin(genome.data(), static_cast<std::int32_t>(genome.size()) - 1) == 0);
  }
}

TEST_CASE("measures are those of the formula's tree") {
  Rng rng(62);
  const CellColumns cells = all_cells(6);
  for (int i = 0; i < 300; ++i) {
    Formula wanted = random_formula(rng, 6, 3);
    evaluate(wanted, cells);
    const Column care = testing::random_column(rng, cells);
    const RunContext run;
    FitnessTable table(cells, wanted.value, care, run);
    Formula f = normalised(random_formula(rng, 6, 4));
    if (f.is_constant()) continue;
    const Genome genome = genome_of(f);
    const Genome literal = {0};
    const std::vector<const Genome*> genomes = {&literal, &genome};
    const auto measured = table.measure(genomes, run);
    REQUIRE(measured.has_value());
    CHECK((*measured)[0].size == 1);
    const Measures m = (*measured)[1];
    evaluate(f, cells);
    const auto wrong = static_cast<int>(count_differences(f.value, wanted.value, care));
    CHECK(m.inside_right + m.outside_right == table.inside_rows() + table.outside_rows() - wrong);
    CHECK(m.size == formula_size(f));
    if (care == cells.all()) CHECK(m.proximity <= m.size);
  }
}

TEST_CASE("evolution keeps the solid and finds smaller trees") {
  Rng rng(63);
  const CellColumns cells = all_cells(5);
  GeneticOptions options;
  options.iterations = 150;
  int smaller = 0;
  for (int i = 0; i < 20; ++i) {
    const Formula f = normalised(random_formula(rng, 5, 4));
    if (f.is_constant()) continue;
    RunContext run;
    run.seed = static_cast<std::uint64_t>(i);
    const auto result = evolved_from(f, cells, options, run);
    REQUIRE(result.has_value());
    REQUIRE(same_on(f, formula_of(result->best), cells, cells.all()));
    CHECK(static_cast<int>(result->best.size()) <= formula_size(f));
    smaller += static_cast<int>(result->best.size()) < formula_size(f) ? 1 : 0;
    for (const ParetoMember& a : result->front) {
      for (const ParetoMember& b : result->front) CHECK_FALSE(dominates(a, b));
    }
    const auto again = evolved_from(f, cells, options, run);
    REQUIRE(again.has_value());
    CHECK(again->evaluations == result->evaluations);
    CHECK(again->best == result->best);
  }
  CHECK(smaller > 3);
}

TEST_CASE("with a negative weight of the size the largest tree wins") {
  const CellColumns cells = all_cells(3);
  const Formula f = Formula::join(Formula::Kind::Or, {Formula::leaf(0), Formula::leaf(1)});
  GeneticOptions options;
  options.iterations = 40;
  options.size_weight = -10;
  options.largest = 5;
  const auto result = evolved_from(f, cells, options, {});
  REQUIRE(result.has_value());
  CHECK(result->best.size() > 10);
  CHECK(result->best.size() <= 15);
  CHECK(same_on(f, formula_of(result->best), cells, cells.all()));
}

TEST_CASE("evolution on a device that breaks ends as on the processor") {
  Rng rng(64);
  const CellColumns cells = all_cells(6);
  const Formula f = normalised(random_formula(rng, 6, 4));
  GeneticOptions options;
  options.iterations = 40;
  RunContext run;
  run.threads = 1;
  const auto expected = evolved_from(f, cells, options, run);
  REQUIRE(expected.has_value());
  for (const int good_calls : {0, 3, 50, 100000}) {
    int warnings = 0;
    testing::FailingDevice* device = nullptr;
    RunContext other;
    other.on_log = [&](const LogEntry& entry) { warnings += entry.severity == Severity::Warning; };
    other.compute = std::make_shared<Compute>(1, DeviceChoice{DeviceChoice::Kind::Cuda, 0},
                                              testing::opens(device, good_calls, testing::kLost));
    const auto found = evolved_from(f, cells, options, other);
    REQUIRE(found.has_value());
    CHECK(found->best == expected->best);
    CHECK(found->evaluations == expected->evaluations);
    REQUIRE(found->front.size() == expected->front.size());
    for (std::size_t i = 0; i < found->front.size(); ++i) {
      CHECK(found->front[i].genome == expected->front[i].genome);
    }
    CHECK(warnings == (good_calls < 100000 ? 1 : 0));
  }
}

TEST_CASE("the archive keeps what nothing dominates") {
  ParetoArchive archive;
  CHECK(archive.offer({{0}, 1, 5, 0.5}));
  CHECK_FALSE(archive.offer({{1}, 1, 5, 0.5}));
  CHECK_FALSE(archive.offer({{1}, 1, 7, 0.5}));
  CHECK(archive.offer({{2}, 1, 7, 0.9}));
  CHECK(archive.offer({{3}, 0.8, 3, 0.5}));
  CHECK(archive.size() == 3);
  CHECK(archive.offer({{4}, 1, 3, 1}));
  CHECK(archive.size() == 1);
  CHECK(archive.front()[0].genome == Genome{4});
}

TEST_CASE("evolution stops on request") {
  const CellColumns cells = all_cells(3);
  RunContext run;
  run.cancel->cancel();
  const auto stopped = evolved_from(Formula::leaf(0), cells, {}, run);
  REQUIRE_FALSE(stopped.has_value());
  CHECK(stopped.error().code == ErrorCode::Cancelled);
}

}  // namespace
}  // namespace hewn
