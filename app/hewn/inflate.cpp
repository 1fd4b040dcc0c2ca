#include "core/synth/inflate.h"

#include <memory>

#include <fmt/format.h>

#include "app/hewn/commands.h"
#include "app/hewn/publish.h"
#include "app/hewn/read_tree.h"

namespace hewn {
namespace {

struct InflateFlags {
  std::string input, output;
  InflateOptions options;
};

Result<void> publish(const InflateFlags& flags, const Tree& tree, Environment& environment) {
  TreeFileOptions options;
  options.part = std::filesystem::path(flags.input).stem().string();
  options.extend_tools = false;  // the very same solid
  return publish_tree(tree, flags.output, options, environment);
}

ExitCode run_inflate(const InflateFlags& flags, Environment& environment) {
  if (auto possible = check_outputs({flags.output}); !possible) {
    return environment.fail(possible.error());
  }
  const auto tree = read_tree_file(flags.input, environment.run);
  if (!tree) return environment.fail(with_input(tree.error(), flags.input));
  const auto larger = inflate(*tree, flags.options, environment.run);
  if (!larger) return environment.fail(with_input(larger.error(), flags.input));
  if (auto done = publish(flags, *larger, environment); !done) {
    return environment.fail(with_input(done.error(), flags.input));
  }
  environment.console->clear();
  if (!environment.flags.is_quiet && flags.output != "-") {
    fmt::print("literals {} -> {}, size {} -> {} -> {}\n", literal_count(*tree),
               literal_count(*larger), tree_size(*tree), tree_size(*larger), flags.output);
  }
  return ExitCode::Done;
}

}  // namespace

void add_inflate(CLI::App& app, RunFlags& run_flags, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("inflate", "Add redundancy to a tree without changing its solid");
  const auto flags = std::make_shared<InflateFlags>();
  InflateOptions& options = flags->options;
  command->add_option("input", flags->input, "tree (.scad .csg .json)")->required();
  command
      ->add_option("-o,--output", flags->output,
                   "the tree: .json keeps every node; .scad .stl .off .obj .ply .step; - prints "
                   "the .scad")
      ->required();
  command->add_option("--iterations", options.iterations, "rounds of all strategies [10]")
      ->check(CLI::Range(0, 100'000));
  const auto add = [&](const char* name, double& value, const char* help) {
    command->add_option(name, value, std::string(help) + " [1]")->check(CLI::Range(0.0, 1.0));
  };
  add("--copied-subtree", options.copied_subtree, "probability a round of A + A or A * A for A");
  add("--double-negation", options.double_negation, "probability a round of !!A for A");
  add("--distributive", options.distributive, "probability a round of A B + A C for A (B + C)");
  add("--absorption", options.absorption, "probability a round of A + A B or A (A + B) for A");
  add("--genetic", options.genetic, "probability a round of redundant parts by genetic search");
  command->add_option("--most-nodes", options.most_nodes, "the largest tree to make [1000]")
      ->check(CLI::Range(1, 1'000'000));
  add_run_flags(*command, run_flags);
  command->callback([&chosen, flags] {
    chosen = [flags](Environment& environment) { return run_inflate(*flags, environment); };
  });
}

}  // namespace hewn
