#include "core/session/recovery.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "core/base/file.h"

namespace hewn {
namespace {

constexpr std::chrono::seconds kInterval{60};
constexpr const char* kPrefix = "unsaved-";

/// The process that a copy's name tells; 0 when it is no copy.
pid_t owner_of(const std::filesystem::path& path) {
  const std::string name = path.stem().string();
  if (path.extension() != ".json" || !name.starts_with(kPrefix)) return 0;
  return static_cast<pid_t>(std::atoi(name.c_str() + std::string(kPrefix).size()));
}

bool is_alive(pid_t process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

}  // namespace

Autosave::~Autosave() { remove(); }

void Autosave::remove() {
  std::error_code ignored;
  if (!file_.empty()) std::filesystem::remove(file_, ignored);
  file_.clear();
  written_.clear();
  last_.reset();
}

Result<void> Autosave::update(const Project& project, bool is_modified, Clock::time_point now) {
  if (!is_modified) {
    remove();
    return {};
  }
  if (last_ && now - *last_ < kInterval) return {};
  return keep(project, now);
}

Result<void> Autosave::keep(const Project& project, Clock::time_point now) {
  std::error_code ignored;
  std::filesystem::create_directories(folder_, ignored);
  std::string text = project_text(project, folder_);
  if (text == written_) return {};
  last_ = now;
  const auto path = folder_ / fmt::format("{}{}.json", kPrefix, ::getpid());
  if (auto done = write_file(path, text); !done) return done;
  file_ = path;
  written_ = std::move(text);
  return {};
}

std::vector<std::filesystem::path> find_recoverable(const std::filesystem::path& folder) {
  std::vector<std::pair<std::filesystem::file_time_type, std::filesystem::path>> found;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
    const pid_t owner = owner_of(entry.path());
    if (owner <= 0 || is_alive(owner)) continue;
    found.emplace_back(entry.last_write_time(failure), entry.path());
  }
  std::sort(found.rbegin(), found.rend());
  std::vector<std::filesystem::path> paths;
  paths.reserve(found.size());
  for (auto& [time, path] : found) paths.push_back(std::move(path));
  return paths;
}

std::filesystem::path state_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state) {
    return std::filesystem::path(state) / "hewn";
  }
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home && *home ? home : "/tmp") / ".local/state/hewn";
}

}  // namespace hewn
