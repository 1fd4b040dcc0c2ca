#include "app/hewn/flags.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace hewn {
namespace {

/// Finds one option by its names. Requires: it exists.
const OptionRef& find_option(const std::vector<OptionSection>& sections, std::string_view section,
                             std::string_view option) {
  const auto in = std::find_if(sections.begin(), sections.end(),
                               [&](const OptionSection& s) { return s.name == section; });
  return *std::find_if(in->options.begin(), in->options.end(),
                       [&](const OptionRef& o) { return o.name == option; });
}

void add_setting_flag(CLI::App& app, const OptionSection& section, const OptionRef& option,
                      SettingFlags& flags) {
  const std::string in(section.name);
  const std::string name(option.name);
  const std::string flag = fmt::format("--{}-{}", in, name);
  const auto take = [&flags, in, name, flag](const std::string& text) {
    // Checked here, so that a bad value is a usage error before any work.
    Settings scratch;
    const std::vector<OptionSection> all = bind_settings(scratch);
    const Result<void> set = set_option(find_option(all, in, name), text);
    if (!set) throw CLI::ValidationError(flag, set.error().message);
    flags.given.push_back({in, name, text});
  };
  app.add_option_function<std::string>(
         flag, take,
         fmt::format("{} [{}; {}]", option.help, option_text(option), allowed_values(option)))
      ->group(fmt::format("{}: {}", section.name, section.title))
      ->type_name("");
}

}  // namespace

void add_device_flag(CLI::App& app, std::optional<DeviceChoice>& device) {
  const auto take = [&device](const std::string& text) {
    const Result<DeviceChoice> choice = DeviceChoice::parse(text);
    if (!choice) throw CLI::ValidationError("--device", choice.error().message);
    device = *choice;
  };
  app.add_option_function<std::string>(
         "--device", take,
         fmt::format("auto, cpu, cuda or cuda:INDEX; never changes the result; {}",
                     option_table<DeviceOptions>()[0].help))
      ->type_name("");
}

void add_run_flags(CLI::App& app, RunFlags& flags) {
  app.add_option("--seed", flags.seed, "seed of all random choices (1)");
  app.add_option("--threads", flags.threads,
                 "worker threads; 0: one per core; never changes "
                 "the result")
      ->check(CLI::Range(0, 1024));
  add_device_flag(app, flags.device);
  app.add_option("--time-limit", flags.time_limit_s,
                 "seconds after which searches return what they have; results then depend on the "
                 "machine's speed")
      ->check(CLI::Range(0.001, 1e6));
  app.add_flag("-q,--quiet", flags.is_quiet, "no progress and no warnings");
}

void add_setting_flags(CLI::App& app, const std::vector<std::string_view>& sections,
                       SettingFlags& flags) {
  app.preparse_callback([&app, sections, &flags](std::size_t) {
    Settings defaults;
    for (const OptionSection& section : bind_settings(defaults)) {
      if (std::find(sections.begin(), sections.end(), section.name) == sections.end()) continue;
      for (const OptionRef& option : section.options) {
        add_setting_flag(app, section, option, flags);
      }
    }
  });
}

Result<Project> project_for(const std::filesystem::path& input, const RunFlags& run,
                            const SettingFlags& settings) {
  Project project;
  if (input.extension() == ".json") {
    auto loaded = load_project(input);
    if (!loaded) return loaded.error();
    project = std::move(*loaded);
  } else {
    project.mesh = input;
  }
  if (run.seed) project.seed = *run.seed;
  if (run.device) {
    project.settings.device = {static_cast<int>(run.device->kind), run.device->index};
  }
  const std::vector<OptionSection> sections = bind_settings(project.settings);
  for (const SettingFlags::Given& given : settings.given) {
    const Result<void> set =
        set_option(find_option(sections, given.section, given.option), given.text);
    if (!set) return set.error();
  }
  return project;
}

Result<void> check_output(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return Error{ErrorCode::FileWrite, "this is a folder; give a file name in it", path.string()};
  }
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, ignored)) {
    return Error{
        ErrorCode::FileWrite,
        fmt::format("cannot write: there is no folder '{}'; create it first", folder.string()),
        path.string()};
  }
  const bool is_device =
      std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored);
  if (::access(is_device ? path.c_str() : folder.c_str(), W_OK) != 0) {
    return Error{ErrorCode::FileWrite,
                 "cannot write: the folder is read-only; choose one you may write to",
                 path.string()};
  }
  return {};
}

}  // namespace hewn
