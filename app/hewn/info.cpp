#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/hewn/commands.h"
#include "core/mesh/load.h"
#include "core/session/report.h"

namespace hewn {
namespace {

struct InfoFlags {
  std::string input;
  bool as_json = false;
  SettingFlags settings;
};

void print_report(const MeshReport& report, const Mesh& mesh) {
  const Vec3 size = mesh.bounds.size();
  fmt::print("format      {}\n", report.format);
  fmt::print("triangles   {} ({} read)\n", mesh.triangles.size(), report.triangles_read);
  fmt::print("vertices    {} ({} read)\n", mesh.vertices.size(), report.vertices_read);
  fmt::print("size        {:.6g} x {:.6g} x {:.6g}, diagonal {:.6g}\n", size.x(), size.y(),
             size.z(), mesh.diagonal());
  fmt::print("area        {:.6g}\nvolume      {:.6g}\n", mesh.total_area, mesh.volume);
  fmt::print("components  {}\n", report.components);
  fmt::print("closed      {}\n", report.is_closed ? "yes" : "no");
  if (!report.is_closed) {
    fmt::print("holes       {} ({} open edges)\n", report.holes, report.boundary_edges);
  }
  fmt::print("non-manifold edges {}, self-intersections {}\n", report.non_manifold_edges,
             report.self_intersections);
  for (const std::string& warning : report.warnings) fmt::print("warning     {}\n", warning);
}

ExitCode run_info(const InfoFlags& flags, Environment& environment) {
  auto project = project_for(flags.input, environment.flags, flags.settings);
  if (!project) return environment.fail(project.error());
  auto loaded = load_mesh(project->mesh, project->settings.load, environment.run);
  if (!loaded) return environment.fail(with_input(loaded.error(), project->mesh));
  environment.console->clear();
  if (flags.as_json) {
    nlohmann::json json = mesh_report_json(loaded->report, loaded->mesh);
    json["warnings"] = loaded->report.warnings;
    fmt::print("{}\n", json.dump(2));
  } else {
    print_report(loaded->report, loaded->mesh);
  }
  return ExitCode::Done;
}

}  // namespace

void add_info(CLI::App& app, RunFlags& run_flags, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("info", "Say what a mesh holds, what was repaired and what is wrong");
  const auto flags = std::make_shared<InfoFlags>();
  command->add_option("input", flags->input, "mesh (.off .stl .obj .ply) or project (.json)")
      ->required();
  command->add_flag("--json", flags->as_json, "machine-readable");
  add_run_flags(*command, run_flags);
  add_setting_flags(*command, {"load"}, flags->settings);
  command->callback([&chosen, flags] {
    chosen = [flags](Environment& environment) { return run_info(*flags, environment); };
  });
}

}  // namespace hewn
