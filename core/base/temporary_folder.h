#pragma once
/// A private folder for the files of one command.
#include <filesystem>

#include "core/base/result.h"

namespace hewn {

/// Owns a folder that only this user may enter; removes it with all that is in it.
class TemporaryFolder {
 public:
  /// Fails with: FileWrite.
  static Result<TemporaryFolder> create();
  /// For a process that ends without leaving its scopes.
  static void remove_all_of_process();
  ~TemporaryFolder();
  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;  ///< empty once moved from
};

}  // namespace hewn
