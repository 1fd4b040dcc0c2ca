#pragma once
/// Copies of unsaved plans, so that a crash loses at most a minute.
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/session/document.h"

namespace hewn {

/// Owns one file in the recovery folder while the process lives.
class Autosave {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Autosave(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// Takes the copy away: the session ended as it should.
  ~Autosave();
  Autosave(const Autosave&) = delete;
  Autosave& operator=(const Autosave&) = delete;

  /// Writes the plan when it has changed since the last copy and that is a minute ago; takes the
  /// copy away when there is nothing unsaved. Fails with: FileWrite; the copy before stays, and the
  /// next try is a minute later.
  Result<void> update(const Project& project, bool is_modified, Clock::time_point now);
  /// Writes the plan now, unless the copy is the same. Fails with: FileWrite.
  Result<void> keep(const Project& project, Clock::time_point now);
  const std::filesystem::path& file() const { return file_; }

 private:
  void remove();

  std::filesystem::path folder_;
  std::filesystem::path file_;  ///< empty until something is written
  std::string written_;
  std::optional<Clock::time_point> last_;  ///< try
};

/// Copies left by processes that are no longer there, newest first. Each is a project file.
std::vector<std::filesystem::path> find_recoverable(const std::filesystem::path& folder);

/// Where this user's copies and settings belong: $XDG_STATE_HOME/hewn or ~/.local/state/hewn.
std::filesystem::path state_folder();

}  // namespace hewn
