#include <memory>

#include <fmt/format.h>

#include "app/hewn/commands.h"

namespace hewn {
namespace {

ExitCode print_plain() {
  Settings defaults;
  for (const OptionSection& section : bind_settings(defaults)) {
    fmt::print("{}\n", section.title);
    for (const OptionRef& option : section.options) {
      fmt::print("  --{}-{} [{}]  {} ({})\n", section.name, option.name, option_text(option),
                 option.help, allowed_values(option));
    }
  }
  return ExitCode::Done;
}

}  // namespace

void add_options(CLI::App& app, RunFlags&, Command& chosen) {
  CLI::App* command = app.add_subcommand("options", "List every tunable with its default");
  const auto as_markdown = std::make_shared<bool>(false);
  command->add_flag("--markdown", *as_markdown, "the text of docs/options.md");
  command->callback([&chosen, as_markdown] {
    chosen = [as_markdown](Environment&) {
      if (!*as_markdown) return print_plain();
      fmt::print("{}", settings_to_markdown());
      return ExitCode::Done;
    };
  });
}

}  // namespace hewn
