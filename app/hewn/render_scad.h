#pragma once
/// OpenSCAD designs as meshes, by the installed `openscad`.
#include <filesystem>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/mesh/load.h"

namespace hewn {

/// Runs `openscad -o output design`; the output's extension says what is made (.off, .csg).
/// Fails with: NotFound (no `openscad`), Format (OpenSCAD refuses the design; the message is its
/// own first error), FileWrite, Cancelled.
Result<void> run_openscad(const std::filesystem::path& design, const std::filesystem::path& output,
                          const RunContext& run);

/// Renders the design to a temporary mesh and loads it.
/// Fails with: FileNotFound (no design), NotFound (no `openscad`), Format (OpenSCAD refuses the
/// design; the message is its own first error), FileWrite, Cancelled, and as `load_mesh`.
Result<LoadedMesh> render_scad(const std::filesystem::path& design, const MeshLoadOptions& options,
                               const RunContext& run);

}  // namespace hewn
