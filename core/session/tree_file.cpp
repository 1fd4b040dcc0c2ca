#include "core/session/tree_file.h"

#include <cctype>
#include <cstdio>

#include <fmt/format.h>

#include "core/base/file.h"
#include "core/base/temporary_folder.h"
#include "core/io/json.h"
#include "core/io/openscad.h"
#include "core/io/step.h"
#include "core/io/stl.h"

namespace hewn {
namespace {

std::string openscad_text(const Tree& tree, const TreeFileOptions& options) {
  ScadHeader header;
  header.part = options.part;
  header.notes = options.warnings;
  if (options.score) {
    header.proximity = options.score->proximity;
    header.agreement = options.score->agreement;
    header.iou = options.score->iou;
    header.hausdorff = options.score->hausdorff;
    header.mean_distance = options.score->mean_distance;
  }
  ScadOptions scad;
  scad.match_facets = options.match_facets;
  scad.extend_tools = options.extend_tools;
  return to_openscad(tree, header, scad);
}

bool is_mesh(const std::string& extension) {
  return extension == ".stl" || extension == ".off" || extension == ".obj" || extension == ".ply";
}

/// What a writer of files makes, by way of a temporary one: no half-made file is ever at `path`,
/// and several outputs can be published at one time.
Result<std::string> solid_file(const Tree& tree, const std::filesystem::path& path,
                               const std::string& extension, const RunContext& run) {
  const auto folder = TemporaryFolder::create();
  if (!folder) return folder.error();
  const std::filesystem::path draft = *folder / ("solid" + extension);
  const Result<void> done = is_mesh(extension) ? write_mesh(tree, draft, TessellationOptions{}, run)
                                               : write_step(tree, draft, run);
  if (done) return read_file(draft);
  Error error = done.error();
  if (error.code != ErrorCode::Cancelled) error.where = path.string();
  return error;
}

}  // namespace

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

Result<void> check_tree_extension(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (path == "-" || extension == ".scad" || extension == ".json" || extension == ".step" ||
      is_mesh(extension)) {
    return {};
  }
  return Error{ErrorCode::InvalidArgument,
               fmt::format("a tree cannot be written as '{}'; use .scad, .json, .stl, .off, .obj, "
                           ".ply or .step",
                           extension),
               path.string()};
}

Result<std::string> tree_file(const Tree& tree, const std::filesystem::path& path,
                              const TreeFileOptions& options, const RunContext& run) {
  if (auto known = check_tree_extension(path); !known) return known.error();
  const std::string extension = lower_extension(path);
  if (path == "-" || extension == ".scad") return openscad_text(tree, options);
  if (extension == ".json") return tree_to_json(tree);
  return solid_file(tree, path, extension, run);
}

Result<void> write_tree_file(const std::string& content, const std::filesystem::path& path) {
  if (path != "-") return write_file(path, content);
  if (std::fwrite(content.data(), 1, content.size(), stdout) == content.size() &&
      std::fflush(stdout) == 0) {
    return {};
  }
  return Error{ErrorCode::FileWrite, "cannot write to standard output; is its reader gone?"};
}

}  // namespace hewn
