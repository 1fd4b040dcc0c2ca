// hewn-variants IN OUTDIR [--seed N]: writes the variants of a part and prints their paths.
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/variants/variants.h"
#include "core/mesh/load.h"

namespace {

int fail(const hewn::Error& error) {
  fmt::print(stderr, "error: {}: {}\n", error.where, error.message);
  return 1;
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
  CLI11_PARSE(app, argc, argv);
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  const auto loaded = hewn::load_mesh(input, {}, run);
  if (!loaded) return fail(loaded.error());
  const std::string stem = std::filesystem::path(input).stem().string();
  const auto paths = hewn::write_variants(loaded->mesh, folder, stem, run);
  if (!paths) return fail(paths.error());
  for (const auto& path : *paths) fmt::print("{}\n", path.string());
  return 0;
}
