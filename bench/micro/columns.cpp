/// From a mesh with known surfaces to bit columns: labelled points, cells, columns.
#include <benchmark/benchmark.h>

#include "bench/micro/sample_part.h"

namespace hewn::bench {
namespace {

Result<SampleTable> build_table(const solids::PartProblem& part) {
  return build_sample_table(part.space, kVolumePoints, part.surfaces.halfspace_of_group, part.run);
}

/// Points, labels (ray casting) and signatures: most of the time to columns.
void build_samples(benchmark::State& state, const char* file) {
  const auto loaded = load_sample(file);
  if (!loaded) return state.SkipWithError(loaded.error().message.c_str());
  const solids::PartProblem part(loaded->mesh, single_thread());
  std::size_t points = 0;
  for (auto _ : state) {
    const auto table = build_table(part);
    if (!table) return state.SkipWithError(table.error().message.c_str());
    points = table->size();
  }
  state.counters["points"] = static_cast<double>(points);
  state.counters["halfspaces"] = static_cast<double>(part.surfaces.halfspaces.size());
}

/// Cells and columns from a given table.
void build_columns(benchmark::State& state, const char* file) {
  const auto loaded = load_sample(file);
  if (!loaded) return state.SkipWithError(loaded.error().message.c_str());
  const solids::PartProblem part(loaded->mesh, single_thread());
  const auto table = build_table(part);
  if (!table) return state.SkipWithError(table.error().message.c_str());
  std::size_t cell_count = 0;
  for (auto _ : state) {
    const Cells cells = find_cells(*table);
    const ColumnTable columns(*table, cells);
    benchmark::DoNotOptimize(columns.column(0, true));
    cell_count = columns.cells();
  }
  state.counters["points"] = static_cast<double>(table->size());
  state.counters["cells"] = static_cast<double>(cell_count);
}

BENCHMARK_CAPTURE(build_samples, bracket, "bracket.off")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_samples, housing, "housing.stl")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_columns, bracket, "bracket.off")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_columns, housing, "housing.stl")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hewn::bench
