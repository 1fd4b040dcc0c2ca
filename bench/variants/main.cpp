// hewn-variants IN OUTDIR [--seed N] [--triangles N]: writes the variants of a part, or one large
// mesh of it, and prints their paths.
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/variants/remesh.h"
#include "bench/variants/variants.h"
#include "core/mesh/load.h"

namespace {

int fail(const hewn::Error& error) {
  fmt::print(stderr, "error: {}: {}\n", error.where, error.message);
  return 1;
}

/// The part in about so many triangles of nearly equal sides.
int write_large(const hewn::Mesh& mesh, double triangles, const std::filesystem::path& path,
                const hewn::RunContext& run) {
  hewn::RemeshOptions options;
  options.min_growth = triangles / static_cast<double>(mesh.triangles.size());
  options.max_triangles = triangles;
  const auto large = hewn::remesh_isotropic(mesh, options, run);
  if (!large) return fail(large.error());
  if (const auto saved = hewn::save_mesh(*large, path); !saved) return fail(saved.error());
  fmt::print("{}\n", path.string());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes variants of a part: rotated, scaled, moved, binary, jittered, remeshed");
  std::string input;
  std::string folder;
  hewn::RunContext run;
  app.add_option("IN", input, "the mesh")->required();
  app.add_option("OUTDIR", folder, "where the variants go; made when missing")->required();
  app.add_option("--seed", run.seed, "chooses the rotation, the shift and the jitter");
  double triangles = 0;
  app.add_option("--triangles", triangles, "instead, only the part in about so many triangles")
      ->check(CLI::Range(1e3, 1e8));
  CLI11_PARSE(app, argc, argv);
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  const auto loaded = hewn::load_mesh(input, {}, run);
  if (!loaded) return fail(loaded.error());
  const std::string stem = std::filesystem::path(input).stem().string();
  if (triangles > 0) {
    return write_large(loaded->mesh, triangles,
                       std::filesystem::path(folder) / (stem + "-large.off"), run);
  }
  const auto paths = hewn::write_variants(loaded->mesh, folder, stem, run);
  if (!paths) return fail(paths.error());
  for (const auto& path : *paths) fmt::print("{}\n", path.string());
  return 0;
}
