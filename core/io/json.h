#pragma once
/// Trees as JSON and back, without loss. The format is versioned; its fields are those of
/// `Literal` and `Node`, nested as the tree is:
///
///     {"format": "hewn-tree", "version": 1,
///      "root": {"op": "difference", "name": "plate", "children": [
///        {"op": "cube", "rotation": [1, 0, 0, 0, 1, 0, 0, 0, 1], "origin": [0, 0, 0],
///         "size": [4, 2, 1]}, ...]}}
///
/// Rotations are row by row; so is the `stretch` that some literals have. An empty tree has
/// `"root": null`.
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/csg/tree.h"

namespace hewn {

inline constexpr int kTreeJsonVersion = 1;
inline constexpr int kDeepestTreeJson = 400;  ///< nested nodes

/// Doubles are printed so that they read back to the same bits.
std::string tree_to_json(const Tree& tree);

/// Literals and nodes come out in depth-first order. `source` names the text in messages.
/// Fails with: Format; `where` is the source with the JSON path of the offending element, as in
/// "part.json: /root/children/2/radius".
Result<Tree> tree_from_json(std::string_view text, const std::string& source);

/// Fails with: FileWrite, InvalidArgument (a number that is not finite).
Result<void> write_tree_json(const Tree& tree, const std::filesystem::path& path);

/// Fails with: FileNotFound, Format.
Result<Tree> read_tree_json(const std::filesystem::path& path);

}  // namespace hewn
