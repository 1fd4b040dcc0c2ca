#include "core/base/temporary_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

namespace hewn {

Result<TemporaryFolder> TemporaryFolder::create() {
  std::error_code code;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(code);
  std::string name = (parent / "hewn_XXXXXX").string();
  if (code || ::mkdtemp(name.data()) == nullptr) {
    return Error{
        ErrorCode::FileWrite,
        "cannot make a folder for temporary files; set TMPDIR to a folder you may write to",
        parent.string()};
  }
  return TemporaryFolder(std::filesystem::path(name));
}

TemporaryFolder::~TemporaryFolder() {
  if (path_.empty()) return;
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})) {}

}  // namespace hewn
