#include "core/base/temporary_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace hewn {
namespace {

/// Begins the names of all folders of this process.
std::string own_prefix() { return "hewn_" + std::to_string(::getpid()) + "_"; }

}  // namespace

Result<TemporaryFolder> TemporaryFolder::create() {
  std::error_code code;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(code);
  std::string name = (parent / (own_prefix() + "XXXXXX")).string();
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

void TemporaryFolder::remove_all_of_process() {
  std::error_code ignored;
  const std::string prefix = own_prefix();
  const std::filesystem::path parent = std::filesystem::temp_directory_path(ignored);
  for (std::filesystem::directory_iterator i(parent, ignored), end; !ignored && i != end;
       i.increment(ignored)) {
    std::error_code kept;
    if (i->path().filename().string().starts_with(prefix)) {
      std::filesystem::remove_all(i->path(), kept);
    }
  }
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})) {}

}  // namespace hewn
