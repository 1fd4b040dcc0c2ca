#include <memory>
#include <mutex>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/hewn/commands.h"
#include "app/hewn/pictures.h"
#include "core/base/file.h"
#include "core/session/reconstruct.h"
#include "core/session/report.h"

namespace hewn {
namespace {

struct SegmentFlags {
  std::string input, output, picture;
  bool is_dark = false;
  SettingFlags settings;
};

std::string dimensions(const Surface& s) {
  switch (s.kind) {
    case SurfaceKind::Plane:
      return fmt::format("normal ({:.4g}, {:.4g}, {:.4g}) offset {:.6g}", s.axis.x(), s.axis.y(),
                         s.axis.z(), s.offset);
    case SurfaceKind::Cone:
      return fmt::format("half angle {:.5g} deg", s.half_angle_rad * 180 / kPi);
    case SurfaceKind::Torus:
      return fmt::format("radius {:.6g} around {:.6g}", s.radius, s.major_radius);
    case SurfaceKind::Sphere:
    case SurfaceKind::Cylinder:
      break;
  }
  return fmt::format("radius {:.6g}", s.radius);
}

void print_groups(const PreparedMesh& prepared) {
  fmt::print("{:>5}  {:<9} {:>7}  {:>9}  {:>9}  {}\n", "group", "kind", "area %", "triangles",
             "off by", "dimensions");
  const auto& groups = prepared.segmentation.groups;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const FaceGroup& group = groups[g];
    fmt::print("{:>5}  {:<9} {:>7.2f}  {:>9}  {:>9.2g}  {}{}\n", g,
               group.is_fitted ? name_of(group.surface.kind) : "free-form",
               100 * group.area / prepared.mesh->total_area, group.triangles.size(),
               group.max_deviation, dimensions(group.surface), group.side < 0 ? ", hollow" : "");
  }
}

Result<void> publish(const SegmentFlags& flags, const SegmentedMesh& result,
                     const std::optional<Image>& picture, Environment& environment) {
  const std::lock_guard lock(environment.interrupt->publishing());
  if (environment.run.is_cancelled()) return RunContext::cancelled();
  if (!flags.output.empty()) {
    const nlohmann::json json = {{"hewn-groups", 1},
                                 {"input", mesh_report_json(result.report, *result.prepared.mesh)},
                                 {"groups", segmentation_json(result.prepared, true)}};
    if (auto done = write_file(flags.output, json.dump(1) + "\n"); !done) return done;
  }
  if (picture) return save_png(*picture, flags.picture);
  return {};
}

ExitCode run_segment(const SegmentFlags& flags, Environment& environment) {
  for (const std::string& path : {flags.output, flags.picture}) {
    if (path.empty()) continue;
    if (auto possible = check_output(path); !possible) return environment.fail(possible.error());
  }
  auto project = project_for(flags.input, environment.flags, flags.settings);
  if (!project) return environment.fail(project.error());
  auto result = segment_project(*project, environment.run);
  if (!result) return environment.fail(with_input(result.error(), project->mesh));
  std::optional<Image> picture;
  if (!flags.picture.empty()) {
    auto drawn = draw_groups(result->prepared, flags.is_dark, environment.run);
    if (!drawn) return environment.fail(drawn.error());
    picture = std::move(*drawn);
  }
  if (auto done = publish(flags, *result, picture, environment); !done) {
    return environment.fail(done.error());
  }
  environment.console->clear();
  if (!environment.flags.is_quiet) print_groups(result->prepared);
  return ExitCode::Done;
}

}  // namespace

void add_segment(CLI::App& app, RunFlags& run_flags, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("segment", "Divide a mesh into face groups and list their surfaces");
  const auto flags = std::make_shared<SegmentFlags>();
  command->add_option("input", flags->input, "mesh, or project whose cuts and merges to apply")
      ->required();
  command->add_option("-o,--output", flags->output, "the groups with their triangles, JSON");
  command->add_option("--picture", flags->picture, "the mesh coloured by group, PNG");
  command->add_flag("--dark", flags->is_dark, "dark background for the picture");
  add_run_flags(*command, run_flags);
  add_setting_flags(*command, {"load", "segment", "curvature"}, flags->settings);
  command->callback([&chosen, flags] {
    chosen = [flags](Environment& environment) { return run_segment(*flags, environment); };
  });
}

}  // namespace hewn
