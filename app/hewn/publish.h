#pragma once
/// Writing what a command has made.
#include <functional>
#include <string>
#include <vector>

#include "app/hewn/commands.h"
#include "core/csg/tree.h"
#include "core/session/tree_file.h"

namespace hewn {

/// Whether a tree can be written to the first path and something to each of the others, asked
/// before the work begins. Empty paths and "-", the standard output, need no file. Fails with:
/// InvalidArgument (no format for a tree has that extension) and as `check_output` does.
Result<void> check_outputs(const std::vector<std::string>& paths);

/// Writes the tree in the format of the path's extension, then what `write_others` writes. Ctrl-C
/// comes before all of it or after.
/// Fails as `tree_file`, `write_tree_file` and `write_others` do, and with Cancelled.
Result<void> publish_tree(const Tree& tree, const std::string& path, const TreeFileOptions& options,
                          Environment& environment,
                          const std::function<Result<void>()>& write_others = {});

}  // namespace hewn
