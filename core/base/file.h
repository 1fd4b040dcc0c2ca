#pragma once
/// Whole-file reading and all-or-nothing writing.
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace hewn {

/// The file's bytes. Fails with: FileNotFound (missing, a folder, no permission).
Result<std::string> read_file(const std::filesystem::path& path);

/// Writes beside `path` and renames, so that `path` holds either the old or the whole new content.
/// Fails with: FileWrite (no such folder, read-only, disk full); nothing is left behind.
Result<void> write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace hewn
