#pragma once
/// Trees as STEP files: exact surfaces for other CAD programs.
#include <filesystem>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/csg/tree.h"

namespace hewn {

/// Writes a STEP AP214 file in millimetres (one model unit is one millimetre).
/// Fails with: InvalidArgument (empty tree), Internal (OpenCASCADE gave up), FileWrite, Cancelled.
Result<void> write_step(const Tree& tree, const std::filesystem::path& path, const RunContext& run);

}  // namespace hewn
