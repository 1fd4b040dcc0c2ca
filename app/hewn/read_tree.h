#pragma once
/// Trees from files of every kind.
#include <filesystem>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"
#include "core/io/scad_read/scad_tree.h"

namespace hewn {

/// Reads a tree from .json, .scad or .csg. A design with loops, modules or functions is flattened
/// by the installed program openscad, and what is no primitive (hull, text, ...) rendered by it.
/// Fails with: FileNotFound, InvalidArgument (another extension), Format and TooLarge (with line
/// and column), NotFound (the program is needed and not there), Cancelled.
Result<Tree> read_tree_file(const std::filesystem::path& path, const RunContext& run,
                            int most_literals = ScadReadOptions{}.most_literals);

}  // namespace hewn
