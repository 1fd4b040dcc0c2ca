/// Full fitness evaluations of the genetic search: bits, size and proximity of 256 random trees of
/// 31 nodes over 64 columns.
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
  const FitnessTable table(cells, wanted, cells.all());
  std::vector<Genome> trees(kTrees);
  for (Genome& tree : trees) append_random(tree, rng, kLeaves);
  FitnessScratch scratch;
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(table.measure(trees[next], scratch));
    next = (next + 1) % kTrees;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(fitness)->Arg(4096)->Arg(65536);

}  // namespace
}  // namespace hewn::bench
