#include "core/mesh/compare.h"

#include <memory>
#include <mutex>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/hewn/commands.h"
#include "app/hewn/render_scad.h"
#include "core/base/file.h"
#include "core/io/json.h"
#include "core/session/score.h"
#include "core/session/tree_file.h"

namespace hewn {
namespace {

struct CompareFlags {
  std::string a, b, report;
  int points = 0;  ///< 0: the defaults of what is compared
  SettingFlags settings;
};

/// Distances are shares of the diagonal of A.
struct Comparison {
  double diagonal = 0;
  double a_to_b_max = 0, b_to_a_max = 0;
  double hausdorff = 0, mean = 0, iou = 0;
};

/// Volumes need more points than distances for the same number of digits.
constexpr int kVolumePerSurfacePoint = 2;

Result<void> check_compared(const std::filesystem::path& path, bool may_be_tree) {
  const std::string extension = lower_extension(path);
  for (const char* known : {".off", ".stl", ".obj", ".ply", ".scad"}) {
    if (extension == known) return {};
  }
  if (extension == ".json" && may_be_tree) return {};
  const char* allowed = may_be_tree ? ".off, .stl, .obj, .ply, .scad or a tree as .json"
                                    : ".off, .stl, .obj, .ply or .scad; a tree goes second";
  return Error{ErrorCode::InvalidArgument,
               fmt::format("cannot compare '{}'; give {}", extension, allowed), path.string()};
}

Result<MeshQuery> query_of(const std::filesystem::path& path, const MeshLoadOptions& options,
                           const RunContext& run) {
  auto loaded = lower_extension(path) == ".scad" ? render_scad(path, options, run)
                                                 : load_mesh(path, options, run);
  if (!loaded) return with_input(loaded.error(), path);
  for (const std::string& warning : loaded->report.warnings) {
    run.warn(fmt::format("{}: {}", path.string(), warning));
  }
  return MeshQuery(std::make_shared<const Mesh>(std::move(loaded->mesh)));
}

Result<Comparison> compare_with_tree(const MeshQuery& a, const CompareFlags& flags,
                                     const RunContext& run) {
  const auto tree = read_tree_json(flags.b);
  if (!tree) return tree.error();
  if (literal_count(*tree) == 0) {
    return Error{ErrorCode::Format, "the tree is empty; give one with a literal", flags.b};
  }
  VerifySettings settings;
  if (flags.points > 0) {
    settings.surface_points = flags.points;
    settings.volume_points = kVolumePerSurfacePoint * flags.points;
  }
  const auto score = score_tree(a, *tree, settings, run);
  if (!score) return score.error();
  return Comparison{a.mesh().diagonal(), score->mesh_to_tree_max, score->tree_to_mesh_max,
                    score->hausdorff,    score->mean_distance,    score->iou};
}

Result<Comparison> compare_with_mesh(const MeshQuery& a, const CompareFlags& flags,
                                     const MeshLoadOptions& load, const RunContext& run) {
  const auto b = query_of(flags.b, load, run);
  if (!b) return b.error();
  CompareOptions options;
  if (flags.points > 0) {
    options.surface_samples = flags.points;
    options.volume_samples = kVolumePerSurfacePoint * flags.points;
  }
  const auto difference = compare_meshes(a, *b, options, run);
  if (!difference) return difference.error();
  return Comparison{a.mesh().diagonal(),   difference->a_to_b.max, difference->b_to_a.max,
                    difference->hausdorff, difference->mean,       difference->iou};
}

Result<void> write_report(const CompareFlags& flags, const Comparison& found,
                          Environment& environment) {
  const nlohmann::json json = {{"hewn-comparison", 1},
                               {"a", flags.a},
                               {"b", flags.b},
                               {"diagonal", found.diagonal},
                               {"hausdorff_rel", found.hausdorff},
                               {"mean_rel", found.mean},
                               {"a_to_b_max_rel", found.a_to_b_max},
                               {"b_to_a_max_rel", found.b_to_a_max},
                               {"iou", found.iou}};
  const std::lock_guard lock(environment.interrupt->publishing());
  if (environment.run.is_cancelled()) return RunContext::cancelled();
  return write_file(flags.report, json.dump(2) + "\n");
}

Result<Comparison> compare(const CompareFlags& flags, Environment& environment) {
  if (auto known = check_compared(flags.a, false); !known) return known.error();
  if (auto known = check_compared(flags.b, true); !known) return known.error();
  if (!flags.report.empty()) {
    if (auto possible = check_output(flags.report); !possible) return possible.error();
  }
  const auto project = project_for(flags.a, environment.flags, flags.settings);
  if (!project) return project.error();
  const MeshLoadOptions& load = project->settings.load;
  const auto a = query_of(flags.a, load, environment.run);
  if (!a) return a.error();
  return lower_extension(flags.b) == ".json" ? compare_with_tree(*a, flags, environment.run)
                                             : compare_with_mesh(*a, flags, load, environment.run);
}

ExitCode run_compare(const CompareFlags& flags, Environment& environment) {
  const auto found = compare(flags, environment);
  if (!found) return environment.fail(found.error());
  if (!flags.report.empty()) {
    if (auto done = write_report(flags, *found, environment); !done) {
      return environment.fail(done.error());
    }
  }
  environment.console->clear();
  fmt::print("Hausdorff   {:.6f} of the diagonal of A ({:.6g})\n", found->hausdorff,
             found->diagonal);
  fmt::print("A to B      {:.6f} at most\nB to A      {:.6f} at most\n", found->a_to_b_max,
             found->b_to_a_max);
  fmt::print("mean        {:.7f}\nIoU         {:.5f}\n", found->mean, found->iou);
  return ExitCode::Done;
}

}  // namespace

void add_compare(CLI::App& app, RunFlags& run_flags, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("compare", "Measure how much a mesh and another mesh or a tree differ");
  const auto flags = std::make_shared<CompareFlags>();
  command->add_option("a", flags->a, "mesh (.off .stl .obj .ply) or design (.scad)")->required();
  command->add_option("b", flags->b, "mesh, design (.scad, needs openscad) or tree (.json)")
      ->required();
  command
      ->add_option("--points", flags->points,
                   "random points on each surface; twice as many for the volumes (meshes: 100000, "
                   "trees: 5000)")
      ->check(CLI::Range(100, 10'000'000));
  command->add_option("--report", flags->report, "the figures as JSON");
  add_run_flags(*command, run_flags);
  add_setting_flags(*command, {"load"}, flags->settings);
  command->callback([&chosen, flags] {
    chosen = [flags](Environment& environment) { return run_compare(*flags, environment); };
  });
}

}  // namespace hewn
