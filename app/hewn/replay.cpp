#include "core/session/replay.h"

#include <memory>

#include <fmt/format.h>

#include "app/hewn/commands.h"

namespace hewn {
namespace {

ExitCode run_replay(const std::string& log, Environment& environment) {
  const auto done = replay_file(log, environment.run);
  if (!done) return environment.fail(with_input(done.error(), log));
  environment.console->clear();
  if (!environment.flags.is_quiet) fmt::print("{} commands carried out\n", done->commands);
  return ExitCode::Done;
}

}  // namespace

void add_replay(CLI::App& app, RunFlags& run_flags, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("replay", "Carry out a recorded log of commands without a window");
  const auto log = std::make_shared<std::string>();
  command->add_option("log", *log, "log file: one command a line")->required();
  command
      ->add_option("--threads", run_flags.threads,
                   "worker threads; 0: one per core; never changes the result")
      ->check(CLI::Range(0, 1024));
  add_device_flag(*command, run_flags.device);
  command->add_flag("-q,--quiet", run_flags.is_quiet, "no progress and no warnings");
  command->callback([&chosen, log] {
    chosen = [log](Environment& environment) { return run_replay(*log, environment); };
  });
}

}  // namespace hewn
