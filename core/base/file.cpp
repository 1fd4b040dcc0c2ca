#include "core/base/file.h"

#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hewn {
namespace {

Error write_error(const std::filesystem::path& path, const char* what, int code) {
  return {ErrorCode::FileWrite,
          std::string("cannot write: ") + what + " (" + std::strerror(code) +
              "); choose a folder you may write to with enough free space",
          path.string()};
}

Error read_error(const std::filesystem::path& path, const char* what, int code) {
  return {ErrorCode::FileNotFound,
          std::string(what) + ": " + std::strerror(code) + "; check the path and its permissions",
          path.string()};
}

/// For a file of a known size, and one byte more to find its end; some for a pipe.
std::size_t room_for(int file) {
  struct stat about = {};
  const bool has_size = ::fstat(file, &about) == 0 && S_ISREG(about.st_mode);
  return has_size ? static_cast<std::size_t>(about.st_size) + 1 : std::size_t{1} << 16;
}

/// Reads to the end into the content, which grows as needed; how much there is, none on failure.
std::optional<std::size_t> read_all(int file, std::string& content) {
  for (std::size_t length = 0;;) {
    if (length == content.size()) content.resize(2 * length);
    const ssize_t n = ::read(file, content.data() + length, content.size() - length);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return std::nullopt;
    if (n == 0) return length;
    length += static_cast<std::size_t>(n);
  }
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
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return read_error(path, "cannot open for reading", errno);
  std::string content(room_for(file), '\0');
  const std::optional<std::size_t> length = read_all(file, content);
  const int code = errno;
  ::close(file);
  if (!length) return read_error(path, "cannot read", code);
  content.resize(*length);
  return content;
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
