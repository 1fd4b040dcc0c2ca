#include "app/hewn-studio/launch.h"

#include <cstdlib>
#include <sstream>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hewn {

bool is_installed(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (folder.empty()) continue;
    const std::filesystem::path file = std::filesystem::path(folder) / program;
    if (::access(file.c_str(), X_OK) == 0) return true;
  }
  return false;
}

Result<void> launch(const std::string& program, const std::filesystem::path& file) {
  // The shell starts it in the background and ends, so that no child is left to wait for.
  std::string command = R"(exec "$0" "$1" >/dev/null 2>&1 </dev/null &)";
  std::string shell = "sh";
  std::string option = "-c";
  std::string name = program;
  std::string argument = file.string();
  char* arguments[] = {shell.data(), option.data(),   command.data(),
                       name.data(),  argument.data(), nullptr};
  pid_t child = 0;
  const int problem = ::posix_spawnp(&child, "sh", nullptr, nullptr, arguments, environ);
  int status = 0;
  if (problem == 0) ::waitpid(child, &status, 0);
  if (problem == 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return Error{ErrorCode::NotFound,
               fmt::format("{} could not be started; open {} by hand", program, file.string())};
}

std::filesystem::path sample_part() {
  std::error_code ignored;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const char* place : {"../share/hewn/bracket.off", "../../assets/bracket.off"}) {
    auto file = (folder / place).lexically_normal();
    if (std::filesystem::is_regular_file(file, ignored)) return file;
  }
  return {};
}

}  // namespace hewn
