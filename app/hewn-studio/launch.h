#pragma once
/// Other programs, and files that come with this one.
#include <filesystem>
#include <string>

#include "core/base/result.h"

namespace hewn {

/// Whether a program of this name stands in one of PATH's folders.
bool is_installed(const std::string& program);

/// Starts `program file` and lets go of it: it outlives this process. Fails with NotFound: it could
/// not be started.
Result<void> launch(const std::string& program, const std::filesystem::path& file);

/// The part for first steps, beside the program or in the source tree it was built from; empty when
/// it is in neither place.
std::filesystem::path sample_part();

}  // namespace hewn
