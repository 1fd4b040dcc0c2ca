/// Random trees of 31 nodes over 64 columns, evaluated against a wanted solid in bits and in
/// floats. `bits_against_floats` measures both in turns on one core and prints the ratio.
#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/micro/float_program.h"
#include "core/base/rng.h"
#include "core/compute/bit_program.h"

namespace hewn::bench {
namespace {

constexpr std::size_t kColumns = 64;
constexpr std::size_t kLeaves = 16;  // and 15 operations: 31 nodes
constexpr std::size_t kTrees = 256;

void push_random_tree(BitProgram& program, Rng& rng, std::size_t leaves) {
  if (leaves == 1) {
    program.push_column(static_cast<int>(rng.below(kColumns)));
    return;
  }
  const std::size_t left = 1 + rng.below(leaves - 1);
  push_random_tree(program, rng, left);
  push_random_tree(program, rng, leaves - left);
  program.push_op(static_cast<BitOp>(rng.below(3)));
}

/// The same trees and points for both ways of evaluation. Column 0 is the wanted solid.
struct Trees {
  explicit Trees(std::size_t point_count) : points(point_count) {
    Rng rng(7, points);
    for (std::size_t c = 0; c < kColumns; ++c) {
      std::vector<float>& distance = distances.emplace_back(points);
      std::vector<Word>& column = bits.emplace_back(padded_words(points), 0);
      for (std::size_t i = 0; i < points; ++i) {
        distance[i] = static_cast<float>(rng.uniform(-1, 1));
        if (distance[i] < 0) set_bit(column.data(), i);
      }
    }
    for (const auto& distance : distances) float_columns.push_back(distance.data());
    for (const auto& column : bits) bit_columns.push_back(column.data());
    programs.resize(kTrees);
    for (BitProgram& program : programs) push_random_tree(program, rng, kLeaves);
  }

  int evaluate_bits(std::size_t tree, BitPath path) const {
    return programs[tree].count_differing(bit_columns, bit_columns[0], points, path);
  }
  int evaluate_floats(std::size_t tree, BitPath path) const {
    return count_differing_signs(programs[tree], float_columns, float_columns[0], points, path);
  }

  std::size_t points;
  std::vector<std::vector<float>> distances;
  std::vector<std::vector<Word>> bits;
  std::vector<const float*> float_columns;
  std::vector<const Word*> bit_columns;
  std::vector<BitProgram> programs;
};

template <class Evaluate>
void measure(benchmark::State& state, const Evaluate& evaluate) {
  const Trees trees(static_cast<std::size_t>(state.range(0)));
  std::size_t tree = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(evaluate(trees, tree));
    tree = (tree + 1) % kTrees;
  }
  state.counters["trees/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

/// Processor time of this thread: what other programs take meanwhile does not count.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Seconds for `evaluate(tree)`, the mean over all trees: enough of them in a row for the caches to
/// hold what this way of evaluation keeps there.
template <class Evaluate>
double seconds_per_tree(const Evaluate& evaluate) {
  const double start = thread_seconds();
  for (std::size_t tree = 0; tree < kTrees; ++tree) benchmark::DoNotOptimize(evaluate(tree));
  return (thread_seconds() - start) / static_cast<double>(kTrees);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Both ways in turns on the same trees, so that a busy machine disturbs both alike; medians.
void compare(benchmark::State& state, BitPath bit_path, BitPath float_path) {
  const Trees trees(static_cast<std::size_t>(state.range(0)));
  for (std::size_t tree = 0; tree < kTrees; ++tree) {
    if (trees.evaluate_bits(tree, bit_path) != trees.evaluate_floats(tree, float_path)) {
      state.SkipWithError("bits and floats disagree");
      return;
    }
  }
  std::vector<double> bits;
  std::vector<double> floats;
  for (auto _ : state) {
    floats.push_back(seconds_per_tree(
        [&](std::size_t tree) { return trees.evaluate_floats(tree, float_path); }));
    bits.push_back(
        seconds_per_tree([&](std::size_t tree) { return trees.evaluate_bits(tree, bit_path); }));
    state.SetIterationTime(bits.back());
  }
  state.counters["bits_us"] = median(bits) * 1e6;
  state.counters["floats_us"] = median(floats) * 1e6;
  state.counters["ratio"] = median(floats) / median(bits);
}

struct NamedPath {
  const char* name;
  BitPath path;
};

bool register_benchmarks() {
  constexpr NamedPath kPaths[] = {
      {"portable", BitPath::Portable}, {"avx2", BitPath::Avx2}, {"avx512", BitPath::Avx512}};
  for (const auto& [name, path] : kPaths) {
    if (bit_kernels(path) == nullptr) continue;
    const auto add = [](const std::string& title, const auto& body) {
      return benchmark::RegisterBenchmark(title.c_str(), body)->Arg(4096)->Arg(65536);
    };
    add(std::string("tree_in_bits/") + name, [path = path](benchmark::State& state) {
      measure(state, [path](const Trees& t, std::size_t k) { return t.evaluate_bits(k, path); });
    });
    add(std::string("tree_in_floats/") + name, [path = path](benchmark::State& state) {
      measure(state, [path](const Trees& t, std::size_t k) { return t.evaluate_floats(k, path); });
    });
    add(std::string("bits_against_floats/") + name,
        [path = path](benchmark::State& state) { compare(state, path, path); })
        ->UseManualTime()
        ->Iterations(15);
  }
  return true;
}

[[maybe_unused]] const bool kIsRegistered = register_benchmarks();

}  // namespace
}  // namespace hewn::bench
