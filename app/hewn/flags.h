#pragma once
/// Flags that several commands share, made from the option tables.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/session/project.h"

namespace hewn {

/// How a command runs, whatever it does.
struct RunFlags {
  std::optional<std::uint64_t> seed;
  int threads = 0;
  std::optional<DeviceChoice> device;
  double time_limit_s = 0;  ///< 0: none
  bool is_quiet = false;
};

/// Values given on the command line for the option tables, in order. They override a project's.
struct SettingFlags {
  struct Given {
    std::string section, option, text;
  };
  std::vector<Given> given;
};

/// Adds --device.
void add_device_flag(CLI::App& app, std::optional<DeviceChoice>& device);

/// Adds --seed, --threads, --device, --time-limit and --quiet.
void add_run_flags(CLI::App& app, RunFlags& flags);

/// Adds `--SECTION-OPTION` for every option of the named sections, once `app` is the command that
/// is parsed: adding hundreds of flags to commands that are not takes a good part of a short run.
void add_setting_flags(CLI::App& app, const std::vector<std::string_view>& sections,
                       SettingFlags& flags);

/// The project of a project file (.json), or one for a mesh alone, with the flags applied.
Result<Project> project_for(const std::filesystem::path& input, const RunFlags& run,
                            const SettingFlags& settings);

/// Fails with FileWrite now when the path could not be written after minutes of work.
Result<void> check_output(const std::filesystem::path& path);

}  // namespace hewn
