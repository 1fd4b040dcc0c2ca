#include "app/hewn/render_scad.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <optional>
#include <sstream>
#include <string>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/file.h"
#include "core/base/temporary_folder.h"

namespace hewn {
namespace {

/// Starts `openscad -o mesh design` with its messages in `log`; empty where there is no program.
std::optional<pid_t> start_openscad(std::string design, std::string mesh, const std::string& log) {
  std::string program = "openscad";
  std::string flag = "-o";
  char* const arguments[] = {program.data(), flag.data(), mesh.data(), design.data(), nullptr};
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  // This process blocks Ctrl-C in its threads; the child must not inherit that.
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  sigset_t none;
  ::sigemptyset(&none);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t child = -1;
  const int failure =
      ::posix_spawnp(&child, program.c_str(), &files, &attributes, arguments, environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  return failure == 0 ? std::optional(child) : std::nullopt;
}

/// Whether the child ended well. Ends it when the run is to stop.
Result<bool> wait_for(pid_t child, const RunContext& run) {
  int status = 0;
  while (true) {
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) return WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (ended < 0 && errno != EINTR) return false;
    if (run.should_stop()) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return RunContext::cancelled();
    }
    run.report("openscad", 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

/// The first line of the log that tells of an error, or its last line.
std::string first_error(const std::filesystem::path& log) {
  const auto text = read_file(log);
  if (!text) return "no message";
  std::istringstream lines(*text);
  std::string line;
  std::string last = "no message";
  while (std::getline(lines, line)) {
    if (line.find("ERROR") != std::string::npos || line.find("empty") != std::string::npos) {
      return line;
    }
    if (!line.empty()) last = line;
  }
  return last;
}

}  // namespace

Result<void> run_openscad(const std::filesystem::path& design, const std::filesystem::path& output,
                          const RunContext& run) {
  const auto folder = TemporaryFolder::create();
  if (!folder) return folder.error();
  const std::filesystem::path log = *folder / "log";
  // An absolute path cannot be taken for a flag.
  const auto child =
      start_openscad(std::filesystem::absolute(design).string(), output.string(), log.string());
  if (!child) {
    return Error{ErrorCode::NotFound,
                 "an OpenSCAD design needs the program openscad, which is not there; install it, "
                 "or give the tree as .json",
                 design.string()};
  }
  const auto is_done = wait_for(*child, run);
  if (!is_done) return is_done.error();
  if (*is_done) return {};
  return Error{ErrorCode::Format,
               fmt::format("openscad cannot render this design: {}", first_error(log)),
               design.string()};
}

Result<LoadedMesh> render_scad(const std::filesystem::path& design, const MeshLoadOptions& options,
                               const RunContext& run) {
  if (const auto readable = read_file(design); !readable) return readable.error();
  const auto folder = TemporaryFolder::create();
  if (!folder) return folder.error();
  const std::filesystem::path mesh = *folder / "design.off";
  if (auto done = run_openscad(design, mesh, run); !done) return done.error();
  auto loaded = load_mesh(mesh, options, run);
  if (loaded) return loaded;
  Error error = loaded.error();
  error.where = design.string();  // not the temporary mesh
  return error;
}

}  // namespace hewn
