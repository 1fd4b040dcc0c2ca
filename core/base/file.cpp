#include "core/base/file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace hewn {
namespace {

Error write_error(const std::filesystem::path& path, const char* what, int code) {
  return {ErrorCode::FileWrite,
          std::string("cannot write: ") + what + " (" + std::strerror(code) +
              "); choose a folder you may write to with enough free space",
          path.string()};
}

bool write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t n = ::write(file, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

}  // namespace

Result<std::string> read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return Error{ErrorCode::FileNotFound, "this is a folder, a file is needed", path.string()};
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    return Error{ErrorCode::FileNotFound,
                 std::string("cannot open for reading: ") + std::strerror(errno) +
                     "; check the path and its permissions",
                 path.string()};
  }
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

Result<void> write_file(const std::filesystem::path& path, std::string_view content) {
  // Devices such as /dev/stdout cannot be replaced by a rename.
  std::error_code ignored;
  const bool in_place =
      std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored);
  const std::string target = path.string();
  const std::string staging = in_place ? target : target + ".part" + std::to_string(::getpid());
  const int file = ::open(staging.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return write_error(path, "the file cannot be created", errno);
  bool ok = write_all(file, content);
  int code = ok ? 0 : errno;
  if (::close(file) != 0 && ok) {
    ok = false;
    code = errno;
  }
  if (ok && !in_place && ::rename(staging.c_str(), target.c_str()) != 0) {
    ok = false;
    code = errno;
  }
  if (ok) return {};
  if (!in_place) ::unlink(staging.c_str());
  return write_error(path, "the content could not be stored", code);
}

}  // namespace hewn
