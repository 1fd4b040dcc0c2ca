#include "core/session/reconstruct.h"

#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/hewn/commands.h"
#include "app/hewn/pictures.h"
#include "app/hewn/publish.h"
#include "core/base/file.h"
#include "core/session/report.h"

namespace hewn {
namespace {

struct ReconstructFlags {
  std::string input, output, report, picture, facets = "true";
  bool is_dark = false;
  SettingFlags settings;
};

Result<void> publish(const ReconstructFlags& flags, const Project& project,
                     const Reconstruction& result, const std::optional<Image>& picture,
                     Environment& environment) {
  TreeFileOptions options;
  options.part = project.mesh.stem().string();
  options.match_facets = flags.facets == "match";
  options.score = result.score;
  options.warnings = result.warnings;
  return publish_tree(result.tree, flags.output, options, environment, [&]() -> Result<void> {
    if (!flags.report.empty()) {
      const std::string text = report_json(project, result).dump(2) + "\n";
      if (auto done = write_file(flags.report, text); !done) return done;
    }
    return picture ? save_png(*picture, flags.picture) : Result<void>{};
  });
}

void print_summary(const ReconstructFlags& flags, const Reconstruction& result) {
  double seconds = 0;
  for (const StageTime& time : result.times) seconds += time.seconds;
  fmt::print(
      "{} literals, size {}, proximity {:.3f}, IoU {:.4f}, largest distance {:.4f} and mean "
      "{:.5f} of the diagonal, {:.2f} s -> {}\n",
      literal_count(result.tree), tree_size(result.tree), result.score.proximity, result.score.iou,
      result.score.hausdorff, result.score.mean_distance, seconds, flags.output);
}

ExitCode run_reconstruct(const ReconstructFlags& flags, Environment& environment) {
  if (auto possible = check_outputs({flags.output, flags.report, flags.picture}); !possible) {
    return environment.fail(possible.error());
  }
  auto project = project_for(flags.input, environment.flags, flags.settings);
  if (!project) return environment.fail(project.error());
  auto result = reconstruct(*project, environment.run);
  if (!result) return environment.fail(with_input(result.error(), project->mesh));
  std::optional<Image> picture;
  if (!flags.picture.empty()) {
    auto drawn =
        draw_input_and_result(result->prepared, result->tree, flags.is_dark, environment.run);
    if (!drawn) return environment.fail(drawn.error());
    picture = std::move(*drawn);
  }
  if (auto done = publish(flags, *project, *result, picture, environment); !done) {
    return environment.fail(done.error());
  }
  environment.console->clear();
  if (!environment.flags.is_quiet && flags.output != "-") print_summary(flags, *result);
  return ExitCode::Done;
}

}  // namespace

void add_reconstruct(CLI::App& app, RunFlags& run_flags, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("reconstruct", "Turn a mesh, or a project file (.json), into a tree");
  const auto flags = std::make_shared<ReconstructFlags>();
  command->add_option("input", flags->input, "mesh (.off .stl .obj .ply) or project (.json)")
      ->required();
  command
      ->add_option("-o,--output", flags->output,
                   "the tree: .scad .json .stl .off .obj .ply .step; - prints the .scad")
      ->required();
  command->add_option("--report", flags->report, "facts, timings and errors as JSON");
  command->add_option("--picture", flags->picture, "input and result side by side, PNG");
  command->add_flag("--dark", flags->is_dark, "dark background for the picture");
  command
      ->add_option_function<std::string>(
          "--search",
          [flags](const std::string& text) {
            flags->settings.given.push_back({"tree", "search", text});
          },
          "list: a decision list, the default; evolve: the published genetic search, to compare "
          "with")
      ->check(CLI::IsMember({"list", "evolve"}));
  command
      ->add_option("--facets", flags->facets,
                   "true: circles are true circles; match: with the mesh's own sides and phase")
      ->check(CLI::IsMember({"true", "match"}));
  add_run_flags(*command, run_flags);
  add_setting_flags(
      *command,
      {"load", "segment", "curvature", "regularise", "tree", "evolve", "verify", "device"},
      flags->settings);
  command->callback([&chosen, flags] {
    chosen = [flags](Environment& environment) { return run_reconstruct(*flags, environment); };
  });
}

}  // namespace hewn
