/// Full fitness evaluations of the genetic search, a generation at a time: bits, size and proximity
/// of 256 random trees of 31 nodes over 64 columns.
#include "core/synth/evolve/fitness.h"

#include <vector>

#include <benchmark/benchmark.h>

#include "core/base/rng.h"

namespace hewn::bench {
namespace {

constexpr int kColumns = 64;
constexpr std::size_t kLeaves = 16;
constexpr std::size_t kTrees = 256;

void append_random(Genome& genome, Rng& rng, std::size_t leaves) {
  if (leaves == 1) {
    genome.push_back(static_cast<Token>(rng.below(kColumns)));
    return;
  }
  const std::size_t left = 1 + rng.below(leaves - 1);
  append_random(genome, rng, left);
  append_random(genome, rng, leaves - left);
  constexpr Token kOps[] = {kUnionToken, kIntersectionToken, kDifferenceToken};
  genome.push_back(kOps[rng.below(3)]);
}

void fitness(benchmark::State& state) {
  const auto points = static_cast<std::size_t>(state.range(0));
  Rng rng(7);
  std::vector<Column> columns(kColumns, Column(padded_words(points), 0));
  for (Column& column : columns) {
    for (std::size_t i = 0; i < points; ++i) {
      if (rng.coin()) set_bit(column.data(), i);
    }
  }
  const Column wanted = columns[0];
  const CellColumns cells(points, std::move(columns));
  RunContext run;
  run.threads = static_cast<int>(state.range(1));
  FitnessTable table(cells, wanted, cells.all(), run);
  std::vector<Genome> trees(kTrees);
  std::vector<const Genome*> generation;
  for (Genome& tree : trees) {
    append_random(tree, rng, kLeaves);
    generation.push_back(&tree);
  }
  for (auto _ : state) benchmark::DoNotOptimize(table.measure(generation, run));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kTrees));
}
BENCHMARK(fitness)->ArgNames({"points", "threads"})->ArgsProduct({{4096, 65536}, {1, 2}});

}  // namespace
}  // namespace hewn::bench
