/// Terms grown from random seed cells, the inner loop of the tree search.
#include <benchmark/benchmark.h>

#include "bench/micro/sample_part.h"
#include "core/sample/separate.h"
#include "core/synth/decompose/grow.h"

namespace hewn::bench {
namespace {

constexpr long kBatch = 48;  ///< terms from the same open cells, as for a state of the beam search

void grow_terms(benchmark::State& state, const char* file) {
  const auto loaded = load_sample(file);
  if (!loaded) return state.SkipWithError(loaded.error().message.c_str());
  solids::PartProblem part(loaded->mesh, single_thread());
  auto table =
      build_sample_table(part.space, kVolumePoints, part.surfaces.halfspace_of_group, part.run);
  if (!table) return state.SkipWithError(table.error().message.c_str());
  Cells cells = find_cells(*table);
  add_separating_halfspaces(part.space, part.surfaces, *table, cells, ArcCut::Chord, part.run);
  const ColumnTable columns(*table, cells);
  const Combinability combinability(part.surfaces);
  TermGrower grower(columns, combinability);
  Rng rng(3);
  long pure = 0;
  for (auto _ : state) {
    if (grower.terms_grown() % kBatch == 0) grower.set_open(columns.all());
    GrowRequest request;
    request.seed = rng.below(columns.cells());
    request.fills = test_bit(columns.wanted().data(), request.seed);
    request.noise = 0.15;
    request.random = rng.next();
    pure += grower.grow(request) ? 1 : 0;
  }
  const auto grown = static_cast<double>(grower.terms_grown());
  state.counters["terms/s"] = benchmark::Counter(grown, benchmark::Counter::kIsRate);
  state.counters["pure"] = static_cast<double>(pure) / grown;
  state.counters["halfspaces"] = static_cast<double>(columns.halfspaces());
  state.counters["cells"] = static_cast<double>(columns.cells());
}

BENCHMARK_CAPTURE(grow_terms, bracket, "bracket.off")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(grow_terms, housing, "housing.stl")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace hewn::bench
