#include <memory>

#include <fmt/format.h>

#include "app/hewn/commands.h"
#include "app/hewn/publish.h"
#include "app/hewn/read_tree.h"

namespace hewn {
namespace {

struct ExportFlags {
  std::string input, output, facets = "true";
};

Result<void> export_tree(const ExportFlags& flags, const Tree& tree, Environment& environment) {
  TreeFileOptions options;
  options.part = std::filesystem::path(flags.input).stem().string();
  options.match_facets = flags.facets == "match";
  return publish_tree(tree, flags.output, options, environment);
}

ExitCode run_export(const ExportFlags& flags, Environment& environment) {
  if (auto possible = check_outputs({flags.output}); !possible) {
    return environment.fail(possible.error());
  }
  const auto tree = read_tree_file(flags.input, environment.run);
  if (!tree) return environment.fail(with_input(tree.error(), flags.input));
  if (auto done = export_tree(flags, *tree, environment); !done) {
    return environment.fail(with_input(done.error(), flags.input));
  }
  environment.console->clear();
  if (!environment.flags.is_quiet && flags.output != "-") {
    fmt::print("{} literals, size {} -> {}\n", literal_count(*tree), tree_size(*tree),
               flags.output);
  }
  return ExitCode::Done;
}

}  // namespace

void add_export(CLI::App& app, RunFlags& run_flags, Command& chosen) {
  CLI::App* command = app.add_subcommand("export", "Write a tree in another format");
  const auto flags = std::make_shared<ExportFlags>();
  command->add_option("input", flags->input, "tree: .json, .scad or .csg")->required();
  command
      ->add_option("-o,--output", flags->output,
                   "the tree: .scad .json .stl .off .obj .ply .step; - prints the .scad")
      ->required();
  command
      ->add_option("--facets", flags->facets,
                   "of .scad: true: circles are true circles; match: with the mesh's own sides")
      ->check(CLI::IsMember({"true", "match"}));
  add_run_flags(*command, run_flags);
  command->callback([&chosen, flags] {
    chosen = [flags](Environment& environment) { return run_export(*flags, environment); };
  });
}

}  // namespace hewn
