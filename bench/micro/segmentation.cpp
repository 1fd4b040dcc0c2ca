/// Face groups of the shipped samples, and the regularised surfaces on them.
#include <benchmark/benchmark.h>

#include "bench/micro/sample_part.h"

namespace hewn::bench {
namespace {

void segment_facets(benchmark::State& state, const char* file) {
  const auto loaded = load_sample(file);
  if (!loaded) return state.SkipWithError(loaded.error().message.c_str());
  std::size_t groups = 0;
  for (auto _ : state) {
    const auto segmentation = segment(loaded->mesh, {}, single_thread());
    if (!segmentation) return state.SkipWithError(segmentation.error().message.c_str());
    groups = segmentation->groups.size();
  }
  state.counters["triangles"] = static_cast<double>(loaded->mesh.triangles.size());
  state.counters["groups"] = static_cast<double>(groups);
}

void regularise_surfaces(benchmark::State& state, const char* file) {
  const auto loaded = load_sample(file);
  if (!loaded) return state.SkipWithError(loaded.error().message.c_str());
  const auto segmentation = segment(loaded->mesh, {}, single_thread());
  if (!segmentation) return state.SkipWithError(segmentation.error().message.c_str());
  std::size_t halfspaces = 0;
  for (auto _ : state) {
    const auto surfaces = regularise(loaded->mesh, *segmentation, {}, single_thread());
    if (!surfaces) return state.SkipWithError(surfaces.error().message.c_str());
    halfspaces = surfaces->halfspaces.size();
  }
  state.counters["halfspaces"] = static_cast<double>(halfspaces);
}

BENCHMARK_CAPTURE(segment_facets, bracket, "bracket.off")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(segment_facets, housing, "housing.stl")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(regularise_surfaces, housing, "housing.stl")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hewn::bench
