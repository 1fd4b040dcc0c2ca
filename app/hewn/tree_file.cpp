#include "app/hewn/tree_file.h"

#include <cstdio>

#include <fmt/format.h>

#include "core/base/file.h"
#include "core/io/openscad.h"

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
  return to_openscad(tree, header, scad);
}

}  // namespace

Result<void> check_tree_extension(const std::filesystem::path& path) {
  if (path == "-" || path.extension() == ".scad") return {};
  return Error{
      ErrorCode::InvalidArgument,
      fmt::format("a tree cannot be written as '{}'; use .scad", path.extension().string()),
      path.string()};
}

Result<std::string> tree_file(const Tree& tree, const std::filesystem::path& path,
                              const TreeFileOptions& options, const RunContext&) {
  if (auto known = check_tree_extension(path); !known) return known.error();
  return openscad_text(tree, options);
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
