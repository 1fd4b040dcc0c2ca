#pragma once
/// Runs a command log without a window.
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/session/session.h"

namespace hewn {

struct Replay {
  int commands = 0;
  std::string plan;  ///< `plan_text` at the end
};

/// Carries out every line of `log`, each to its end before the next. Relative paths in the log are
/// taken from the working folder. The result is the same as that of the recorded session.
/// Fails with: Format (`where` names the line), what the failing command failed with, Cancelled.
Result<Replay> replay_log(std::string_view log, const std::string& source, const RunContext& run);

/// Reads the log from a file. Fails with: FileNotFound as well.
Result<Replay> replay_file(const std::filesystem::path& path, const RunContext& run);

}  // namespace hewn
