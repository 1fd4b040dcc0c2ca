#include "app/hewn/read_tree.h"

#include <fmt/format.h>

#include "app/hewn/render_scad.h"
#include "core/base/file.h"
#include "core/base/temporary_folder.h"
#include "core/io/json.h"
#include "core/session/tree_file.h"

namespace hewn {
namespace {

/// Flattens the design with the program and reads the outcome.
Result<Tree> read_flattened(const std::filesystem::path& path, const Error& why,
                            ScadReadOptions options, const RunContext& run) {
  const auto folder = TemporaryFolder::create();
  if (!folder) return folder.error();
  const std::filesystem::path flat = *folder / "design.csg";
  if (auto done = run_openscad(path, flat, run); !done) {
    return done.error().code == ErrorCode::NotFound ? why : done.error();
  }
  const auto text = read_file(flat);
  if (!text) return text.error();
  options.render = [&](const std::string& part) -> Result<Mesh> {
    const std::filesystem::path file = *folder / "part.scad";
    if (auto done = write_file(file, part); !done) return done.error();
    auto mesh = render_scad(file, {}, run);
    if (!mesh) return mesh.error();
    if (mesh->report.is_closed) return std::move(mesh->mesh);
    return Error{ErrorCode::BadMesh, "the rendered construct is not closed"};
  };
  return tree_from_scad(*text, path.string() + " (flattened)", options, run);
}

}  // namespace

Result<Tree> read_tree_file(const std::filesystem::path& path, const RunContext& run,
                            int most_literals) {
  const std::string extension = lower_extension(path);
  if (extension == ".json") return read_tree_json(path);
  if (extension != ".scad" && extension != ".csg") {
    return Error{
        ErrorCode::InvalidArgument,
        fmt::format("a tree cannot be read from '{}'; give .scad, .csg or .json", extension),
        path.string()};
  }
  const auto text = read_file(path);
  if (!text) return text.error();
  ScadReadOptions options;
  options.most_literals = most_literals;
  auto tree = tree_from_scad(*text, path.string(), options, run);
  if (tree || tree.error().code != ErrorCode::NotFound) return tree;
  return read_flattened(path, tree.error(), options, run);
}

}  // namespace hewn
