// Every optimisation method on the same trees: size, proximity and time in one table.
//
//   optimise_methods [--inflate SEEDS | --cells] TREE.scad|TREE.json ...
//
// With --inflate, variants inflated by both of the paper's settings instead: all strategies for 10
// iterations (data set 1), and the genetic one alone for 20 (data set 2). With --cells, the ways to
// sample the cells from which redundancy removal and decomposition judge.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/file.h"
#include "core/csg/literal_set.h"
#include "core/io/json.h"
#include "core/io/scad_read/scad_tree.h"
#include "core/sample/point_sets.h"
#include "core/synth/inflate.h"
#include "core/synth/optimise.h"
#include "core/synth/simplify/dominant.h"

namespace hewn {
namespace {

struct Method {
  const char* name;
  RemainingMethod method;
};

constexpr Method kMethods[] = {{"Quine-McCluskey", RemainingMethod::QuineMcCluskey},
                               {"Espresso", RemainingMethod::Espresso},
                               {"set cover", RemainingMethod::SetCover},
                               {"annealing", RemainingMethod::Annealing},
                               {"genetic", RemainingMethod::Genetic},
                               {"rewrite", RemainingMethod::Rewrite}};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Result<Tree> read(const std::filesystem::path& path) {
  if (path.extension() == ".json") return read_tree_json(path);
  const auto text = read_file(path);
  if (!text) return text.error();
  return tree_from_scad(*text, path.string(), {}, {});
}

/// One line per method for the solid that decomposition leaves of the tree.
void compare_methods(const std::string& name, const Tree& tree) {
  LiteralSet set;
  const std::vector<int> literal_of = set.add(tree);
  ArrangementSampler sampler(set.literals(), tree.bounds().diagonal());
  RunContext run;
  if (!sampler.sample({}, run)) return;
  const CellColumns cells(sampler.arrangement());
  Decomposition d = decompose(formula_of(tree, literal_of), cells, cells.all(), run);
  evaluate(d.rest, cells);
  fmt::print("| {} | {} | {} | {} | (decomposition) | {} | {:.3f} | |\n", name, tree_size(tree),
             leaf_count(d.rest), cells.cells(), formula_size(recomposed(d, d.rest)),
             formula_proximity(recomposed(d, d.rest), cells));
  if (leaf_count(d.rest) < 2) return;
  for (const Method& m : kMethods) {
    const auto start = std::chrono::steady_clock::now();
    auto rebuilt = rebuild_remaining(m.method, d.rest, cells, d.care, {}, run);
    const double seconds = seconds_since(start);
    if (!rebuilt) {
      fmt::print("| {} | | | | {} | - | - | {} |\n", name, m.name, rebuilt.error().message);
      continue;
    }
    Formula whole = recomposed(d, std::move(*rebuilt));
    evaluate(whole, cells);
    Formula wanted = formula_of(tree, literal_of);
    evaluate(wanted, cells);
    const bool is_same = count_differences(whole.value, wanted.value, cells.all()) == 0;
    fmt::print("| {} | | | | {} | {} | {:.3f} | {:.0f} ms{} |\n", name, m.name, formula_size(whole),
               formula_proximity(whole, cells), seconds * 1000, is_same ? "" : " WRONG");
  }
}

/// Cells found by lines along the faces, by an octree and by a grid, and whether what decomposition
/// makes of them is still right on all cells that lines find.
void compare_samplings(const std::string& name, const Tree& tree) {
  LiteralSet set;
  const std::vector<int> literal_of = set.add(tree);
  const double scale = tree.bounds().diagonal();
  RunContext run;
  ArrangementSampler judge(set.literals(), scale);
  if (!judge.sample({}, run)) return;
  const CellColumns all(judge.arrangement());
  for (const auto& [sampling, label] : {std::pair{CellSampling::Lines, "lines"},
                                        {CellSampling::Octree, "octree"},
                                        {CellSampling::Grid, "grid"}}) {
    const auto start = std::chrono::steady_clock::now();
    ArrangementSampler sampler(set.literals(), scale);
    const Arrangement& a = sampler.arrangement();
    if (!sample_cells(sampler, sampling, {}, run)) return;
    const double sampled = seconds_since(start);
    const CellColumns cells(a);
    const Decomposition d = decompose(formula_of(tree, literal_of), cells, cells.all(), run);
    Formula whole = recomposed(d, d.rest);
    const int size = formula_size(whole);
    Formula wanted = formula_of(tree, literal_of);
    evaluate(whole, all);
    evaluate(wanted, all);
    fmt::print("| {} | {} | {} of {} | {:.0f} ms | {:.1f} ms | {} | {} |\n", name, label, a.size(),
               all.cells(), sampled * 1000, (seconds_since(start) - sampled) * 1000, size,
               count_differences(whole.value, wanted.value, all.all()));
  }
}

/// Data sets 1 and 2 of Friedrich et al. 2020, section 6.1.
InflateOptions data_set(int number) {
  InflateOptions options;
  if (number == 1) return options;
  options.iterations = 20;
  options.copied_subtree = options.double_negation = 0;
  options.distributive = options.absorption = 0;
  return options;
}

/// How many inflated variants come back to the size of the tree itself or below.
void compare_inflated(const std::string& name, const Tree& tree, int seeds, int set) {
  int back = 0;
  int largest = 0;
  int least = std::numeric_limits<int>::max();
  double seconds = 0;
  const auto plain = optimise(tree, {}, {});
  if (!plain) return;
  for (int seed = 1; seed <= seeds; ++seed) {
    RunContext run;
    run.seed = static_cast<std::uint64_t>(seed);
    const auto larger = inflate(tree, data_set(set), run);
    if (!larger) return;
    largest = std::max(largest, tree_size(*larger));
    least = std::min(least, tree_size(*larger));
    const auto start = std::chrono::steady_clock::now();
    const auto result = optimise(*larger, {}, run);
    seconds += seconds_since(start);
    if (result && result->after.size <= tree_size(tree)) ++back;
  }
  fmt::print("| {} | {} | {} | {} | {} to {} | {} of {} | {:.2f} s |\n", name, tree_size(tree),
             plain->after.size, set, least, largest, back, seeds, seconds / seeds);
}

int run_all(int count, char** arguments) {
  int seeds = 0;
  bool compares_cells = false;
  std::vector<std::filesystem::path> files;
  for (int i = 1; i < count; ++i) {
    if (std::string(arguments[i]) == "--inflate" && i + 1 < count) {
      seeds = std::atoi(arguments[++i]);
    } else if (std::string(arguments[i]) == "--cells") {
      compares_cells = true;
    } else {
      files.emplace_back(arguments[i]);
    }
  }
  if (compares_cells) {
    fmt::print(
        "| tree | sampling | cells | sampling time | decomposition | size | wrong cells |\n");
    fmt::print("|---|---|---|---|---|---|---|\n");
  } else if (seeds == 0) {
    fmt::print("| tree | size | remaining literals | cells | method | size | proximity | time |\n");
    fmt::print("|---|---|---|---|---|---|---|---|\n");
  } else {
    fmt::print("| tree | size | optimised alone | data set | inflated | back | mean time |\n");
    fmt::print("|---|---|---|---|---|---|---|\n");
  }
  for (const std::filesystem::path& file : files) {
    const auto tree = read(file);
    if (!tree) {
      fmt::print(stderr, "{}: {}\n", tree.error().where, tree.error().message);
      return 1;
    }
    const std::string name = file.stem().string();
    if (compares_cells) compare_samplings(name, *tree);
    if (seeds == 0 && !compares_cells) compare_methods(name, *tree);
    for (const int set : {1, 2}) {
      if (seeds > 0) compare_inflated(name, *tree, seeds, set);
    }
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace hewn

int main(int argc, char** argv) { return hewn::run_all(argc, argv); }
