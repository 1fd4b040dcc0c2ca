#include "core/synth/optimise.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/hewn/commands.h"
#include "app/hewn/publish.h"
#include "app/hewn/read_tree.h"
#include "core/base/file.h"
#include "core/io/json.h"

namespace hewn {
namespace {

using Json = nlohmann::ordered_json;

struct OptimiseFlags {
  std::string input, output, report, front, qubo, method = "rewrite", cells = "lines";
  std::vector<double> weights;
  double tolerance = 0;
  int effort = 1;
  bool keeps_primitives = false;
  std::size_t points = EquivalenceOptions{}.points;
};

/// In the order of `OptimiseMethod`.
constexpr const char* kMethods[] = {"redundancy", "rewrite",   "dominant",  "quine-mccluskey",
                                    "espresso",   "set-cover", "annealing", "genetic"};

/// In the order of `CellSampling`.
constexpr const char* kCellSamplings[] = {"lines", "octree", "grid"};

template <std::size_t N>
std::size_t index_of(const std::string& name, const char* const (&names)[N]) {
  return static_cast<std::size_t>(std::find(names, names + N, name) - names);
}

const char* name_of(SolidExtent extent) {
  switch (extent) {
    case SolidExtent::Bounded:
      return "solid";
    case SolidExtent::Empty:
      return "empty";
    case SolidExtent::Everything:
      break;
  }
  return "everything";
}

Json figures_json(const TreeFigures& figures) {
  return {{"literals", figures.literals}, {"size", figures.size}, {"proximity", figures.proximity}};
}

Json equivalence_json(const OptimiseResult& result) {
  const Equivalence& e = result.equivalence;
  return {{"cells_compared", result.cells},
          {"cells_changed", result.changed_cells},
          {"cells_free_to_change", result.tolerated_cells},
          {"resolution", result.resolution},
          {"proved_volume_share", e.proved_share},
          {"points_compared", e.points},
          {"points_different", e.different},
          {"points_different_within_tolerance", e.tolerated},
          {"largest_distance", e.largest_distance},
          {"smallest_octree_cell", e.smallest_cell}};
}

/// What the tolerance let go, thickest first.
Json thin_features_json(const OptimiseResult& result) {
  Json features = Json::array();
  for (const ThinFeature& f : result.thin_features) {
    features.push_back({{"change", f.is_filled ? "filled" : "removed"},
                        {"at", {f.at.x(), f.at.y(), f.at.z()}},
                        {"thickness", f.thickness},
                        {"cells", f.cells}});
  }
  return features;
}

Json report_json(const OptimiseFlags& flags, const OptimiseResult& result, std::uint64_t seed) {
  Json redundancy = {{"empty", result.redundancy.empty},
                     {"universal", result.redundancy.universal},
                     {"decided", result.redundancy.decided},
                     {"replaced", result.redundancy.replaced},
                     {"passes", result.redundancy.passes}};
  Json seconds;
  double total = 0;
  for (const StageSeconds& s : result.seconds) {
    seconds[s.stage] = s.seconds;
    total += s.seconds;
  }
  seconds["total"] = total;
  return {{"hewn-optimise", 1},
          {"tree", std::filesystem::path(flags.input).filename().string()},
          {"seed", seed},
          {"method", flags.method},
          {"cells", flags.cells},
          {"tolerance", flags.tolerance},
          {"effort", flags.effort},
          {"keep_primitives", flags.keeps_primitives},
          {"solid", name_of(result.extent)},
          {"kept_input", result.is_input},
          {"rounds", result.rounds},
          {"before", figures_json(result.before)},
          {"after", figures_json(result.after)},
          {"redundancy", std::move(redundancy)},
          {"remaining_literals", result.remaining_literals},
          {"equivalence", equivalence_json(result)},
          {"thin_features", thin_features_json(result)},
          {"seconds", std::move(seconds)}};
}

/// Every member with its whole tree, in the format of tree files.
std::string front_json(const OptimiseResult& result) {
  Json members = Json::array();
  for (const FrontMember& m : result.front) {
    members.push_back({{"geometry", m.geometry},
                       {"size", m.size},
                       {"proximity", m.proximity},
                       {"tree", Json::parse(tree_to_json(m.tree))}});
  }
  const Json document = {{"hewn-front", 1}, {"members", std::move(members)}};
  return document.dump(1) + "\n";
}

Result<void> publish(const OptimiseFlags& flags, const OptimiseResult& result,
                     Environment& environment) {
  TreeFileOptions options;
  options.part = std::filesystem::path(flags.input).stem().string();
  options.extend_tools = false;  // the very same solid
  return publish_tree(result.tree, flags.output, options, environment, [&]() -> Result<void> {
    if (!flags.front.empty()) {
      if (auto done = write_file(flags.front, front_json(result)); !done) return done;
    }
    if (!flags.qubo.empty()) {
      if (auto done = write_file(flags.qubo, result.qubo); !done) return done;
    }
    if (flags.report.empty()) return {};
    const std::uint64_t seed = environment.run.seed;
    return write_file(flags.report, report_json(flags, result, seed).dump(2) + "\n");
  });
}

void print_thin_features(const std::vector<ThinFeature>& features) {
  const auto filled = std::count_if(features.begin(), features.end(),
                                    [](const ThinFeature& f) { return f.is_filled; });
  fmt::print("thin features: {} removed, {} filled", features.size() - filled, filled);
  if (!features.empty()) {
    const ThinFeature& f = features.front();
    fmt::print("; the thickest, {:.4g}, at ({:.6g}, {:.6g}, {:.6g})", f.thickness, f.at.x(),
               f.at.y(), f.at.z());
  }
  fmt::print("\n");
}

void print_summary(const OptimiseFlags& flags, const OptimiseResult& result) {
  double seconds = 0;
  for (const StageSeconds& s : result.seconds) seconds += s.seconds;
  if (result.extent != SolidExtent::Bounded) {
    fmt::print("the solid is {}\n", name_of(result.extent));
  }
  fmt::print(
      "literals {} -> {}, size {} -> {}, proximity {:.3f} -> {:.3f}; {} cells and {} points agree, "
      "{:.2f} s -> {}\n",
      result.before.literals, result.after.literals, result.before.size, result.after.size,
      result.before.proximity, result.after.proximity, result.cells - result.changed_cells,
      result.equivalence.points - result.equivalence.tolerated, seconds, flags.output);
  if (flags.tolerance > 0) {
    print_thin_features(result.thin_features);
  }
}

ExitCode run_optimise(const OptimiseFlags& flags, Environment& environment) {
  const auto possible = check_outputs({flags.output, flags.report, flags.front, flags.qubo});
  if (!possible) return environment.fail(possible.error());
  const auto tree = read_tree_file(flags.input, environment.run, kMostOptimisedLiterals);
  if (!tree) return environment.fail(with_input(tree.error(), flags.input));
  OptimiseOptions options;
  options.method = static_cast<OptimiseMethod>(index_of(flags.method, kMethods));
  options.cells = static_cast<CellSampling>(index_of(flags.cells, kCellSamplings));
  options.tolerance = flags.tolerance;
  options.effort = flags.effort;
  options.derives_primitives = !flags.keeps_primitives;
  options.rebuilds = !flags.keeps_primitives;
  options.equivalence.points = flags.points;
  options.wants_front = !flags.front.empty();
  options.wants_qubo = !flags.qubo.empty();
  if (options.wants_qubo && options.method == OptimiseMethod::Rewrite) {
    options.method = OptimiseMethod::SetCover;
  }
  if (flags.weights.size() == 3) {
    options.remaining.genetic.geometry_weight = flags.weights[0];
    options.remaining.genetic.proximity_weight = flags.weights[1];
    options.remaining.genetic.size_weight = flags.weights[2];
  }
  const auto result = optimise(*tree, options, environment.run);
  if (!result) return environment.fail(with_input(result.error(), flags.input));
  if (auto done = publish(flags, *result, environment); !done) {
    return environment.fail(with_input(done.error(), flags.input));
  }
  environment.console->clear();
  if (!environment.flags.is_quiet && flags.output != "-") print_summary(flags, *result);
  return ExitCode::Done;
}

}  // namespace

void add_optimise(CLI::App& app, RunFlags& run_flags, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("optimise", "Make a tree smaller without changing its solid");
  const auto flags = std::make_shared<OptimiseFlags>();
  command->add_option("input", flags->input, "tree (.scad .csg .json)")->required();
  command
      ->add_option("-o,--output", flags->output,
                   "the tree: .scad .json .stl .off .obj .ply .step; - prints the .scad")
      ->required();
  command->add_option("--report", flags->report, "sizes, times and proof of equivalence as JSON");
  command
      ->add_option(
          "--method", flags->method,
          "rewrite: rebuild parts as long as they get smaller; redundancy: only remove what "
          "is not needed; the others peel off dominant primitives and rebuild the rest: "
          "dominant (not at all), quine-mccluskey, espresso, set-cover, annealing, genetic "
          "[rewrite]")
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(kMethods), std::end(kMethods))));
  command
      ->add_option("--cells", flags->cells,
                   "where the search starts: lines along all faces, or the published octree or "
                   "grid, whose results may take more rounds to get right [lines]")
      ->check(CLI::IsMember(
          std::vector<std::string>(std::begin(kCellSamplings), std::end(kCellSamplings))));
  command
      ->add_option("--weights", flags->weights,
                   "of geometry, proximity and size in the genetic search [50,1,10]")
      ->delimiter(',')
      ->expected(3)
      ->check(CLI::NonNegativeNumber);
  command->add_option("--front", flags->front,
                      "the trees that no other one beats in geometry, size and proximity, JSON");
  command->add_option("--qubo", flags->qubo,
                      "the remaining solid's set cover as a QUBO matrix, JSON; with a method other "
                      "than rewrite and redundancy (set-cover if none is given)");
  command
      ->add_option("--tolerance", flags->tolerance,
                   "features thinner than this share of the diagonal may go or be filled [0]")
      ->check(CLI::Range(0.0, 0.49));
  command->add_option("--effort", flags->effort, "how long to search, in units of the default [1]")
      ->check(CLI::Range(1, 1000));
  command->add_flag("--keep-primitives", flags->keeps_primitives,
                    "use the input's primitives only; none that stands for several");
  command
      ->add_option("--points", flags->points,
                   "fresh points on which both solids are compared [50000]")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1'000'000'000}));
  add_run_flags(*command, run_flags);
  command->callback([&chosen, flags] {
    chosen = [flags](Environment& environment) { return run_optimise(*flags, environment); };
  });
}

}  // namespace hewn
