#pragma once
/// A boundary representation as a STEP file.
#include "core/io/brep/module.h"

namespace hewn {

/// See `BrepFunctions::write_step`.
Result<void> write_step_brep(const BrepInput& input, const std::filesystem::path& path,
                             const RunContext& run);

}  // namespace hewn
