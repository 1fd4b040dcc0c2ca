#include <memory>
#include <mutex>

#include <fmt/format.h>

#include "app/hewn/commands.h"
#include "app/hewn/read_tree.h"
#include "core/session/tree_file.h"

namespace hewn {
namespace {

struct ExportFlags {
  std::string input, output, facets = "true";
};

Result<void> export_tree(const ExportFlags& flags, const Tree& tree, Environment& environment) {
  TreeFileOptions options;
  options.part = std::filesystem::path(flags.input).stem().string();
  options.match_facets = flags.facets == "match";
  const auto content = tree_file(tree, flags.output, options, environment.run);
  if (!content) return content.error();
  const std::lock_guard lock(environment.interrupt->publishing());
  if (environment.run.is_cancelled()) return RunContext::cancelled();
  return write_tree_file(*content, flags.output);
}

ExitCode run_export(const ExportFlags& flags, Environment& environment) {
  if (auto known = check_tree_extension(flags.output); !known) {
    return environment.fail(known.error());
  }
  if (flags.output != "-") {
    if (auto possible = check_output(flags.output); !possible) {
      return environment.fail(possible.error());
    }
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
