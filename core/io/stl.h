#pragma once
/// Trees as triangle meshes: Booleans on exact surfaces, tessellated last.
#include <filesystem>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"

namespace hewn {

struct TessellationOptions {
  double angle_deg = 3.75;   ///< between neighbouring facets of a curved face, (0, 90]
  double deflection = 1e-3;  ///< largest chord height, share of the bounding-box diagonal
  int check_points = 2000;   ///< of the result's comparison with the tree; 0 to skip it
};

/// A closed mesh of the tree's solid. Tries all operands of an operation at once, then two by two,
/// then with a tolerance, until the mesh is closed and agrees with the tree at the check points.
/// Fails with: InvalidArgument (empty tree, option out of range), Internal (no strategy gave a
/// right mesh; the message says what was wrong with the last), Cancelled.
Result<Mesh> tessellate(const Tree& tree, const TessellationOptions& options,
                        const RunContext& run);

/// Tessellates and writes STL (binary), OFF, OBJ or PLY after the path's extension.
/// Fails with: those of `tessellate`, FileWrite.
Result<void> write_mesh(const Tree& tree, const std::filesystem::path& path,
                        const TessellationOptions& options, const RunContext& run);

}  // namespace hewn
