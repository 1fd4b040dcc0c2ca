#pragma once
/// Trees as files, the format chosen by the extension.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"
#include "core/session/score.h"

namespace hewn {

/// What the .scad tells beside the tree; other formats leave it out.
struct TreeFileOptions {
  std::string part;
  bool match_facets = false;
  bool extend_tools = true;  ///< flush ends of subtracted solids stick out
  std::optional<TreeScore> score;
  std::vector<std::string> warnings;
};

/// The file's content: .scad (also for the path "-"), .json, .stl, .off, .obj, .ply or .step.
/// Fails with: InvalidArgument (any other extension, an empty tree as mesh or STEP), Internal (the
/// Booleans of a mesh or STEP gave no right solid), FileWrite (no temporary folder), Cancelled.
Result<std::string> tree_file(const Tree& tree, const std::filesystem::path& path,
                              const TreeFileOptions& options, const RunContext& run);

/// Writes the content; "-" is standard output.
Result<void> write_tree_file(const std::string& content, const std::filesystem::path& path);

/// Fails with InvalidArgument when `tree_file` would refuse the path's extension.
Result<void> check_tree_extension(const std::filesystem::path& path);

/// The extension in lower case, with its dot.
std::string lower_extension(const std::filesystem::path& path);

}  // namespace hewn
