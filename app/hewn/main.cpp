/// The command line: parses, wires, runs.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "app/heap.h"
#include "app/hewn/commands.h"
#include "core/compute/compute.h"
#include "gpu/cuda_device.h"

namespace hewn {
namespace {

void wire(Environment& environment) {
  const RunFlags& flags = environment.flags;
  environment.run.threads = flags.threads;
  if (flags.seed) environment.run.seed = *flags.seed;
  Console* console = environment.console;
  environment.run.on_progress = [console](const char* stage, double share) {
    console->progress(stage, share);
  };
  environment.run.on_log = [console](const LogEntry& entry) { console->log(entry); };
  environment.run.compute = std::make_shared<Compute>(
      flags.threads, flags.device.value_or(DeviceChoice{}), open_cuda_device);
  environment.run.compute->prepare(environment.run);
  if (flags.time_limit_s > 0) {
    const std::chrono::duration<double> limit(flags.time_limit_s);
    environment.run.deadline =
        std::chrono::steady_clock::now() +
        std::chrono::duration_cast<std::chrono::steady_clock::duration>(limit);
  }
}

ExitCode carry_out(const Command& command, Environment& environment) {
  const Error unwritable{ErrorCode::FileWrite,
                         "cannot write to standard output; is the disk full or its reader gone?"};
  try {
    const ExitCode code = command(environment);
    const bool is_written = std::fflush(stdout) == 0;
    return code == ExitCode::Done && !is_written ? environment.fail(unwritable) : code;
  } catch (const std::system_error& problem) {
    if (std::ferror(stdout) != 0) return environment.fail(unwritable);
    return environment.fail({ErrorCode::Internal, fmt::format("the system refused a service: {}; "
                                                              "try fewer threads",
                                                              problem.what())});
  } catch (const std::bad_alloc&) {
    return environment.fail(
        {ErrorCode::Internal, "out of memory; try a smaller mesh or fewer sample points"});
  } catch (const std::exception& bug) {
    return environment.fail(
        {ErrorCode::Internal, fmt::format("something inside broke: {}; please report it with the "
                                          "input",
                                          bug.what())});
  }
}

/// Ends the process without taking it down piece by piece: what is left is memory, which the system
/// takes back at once. On a small tree that was a fifteenth of the time.
[[noreturn]] void run_command(const Command& command, const RunFlags& flags) {
  Environment environment;
  environment.flags = flags;
  Console console(flags.is_quiet);
  Interrupt interrupt(environment.run.cancel);
  environment.console = &console;
  environment.interrupt = &interrupt;
  wire(environment);
  const ExitCode code = carry_out(command, environment);
  std::fflush(nullptr);
  std::_Exit(static_cast<int>(code));
}

struct KnownCommand {
  const char* name;
  void (*add)(CLI::App&, RunFlags&, Command&);
  bool reads_meshes = false;
};
constexpr KnownCommand kCommands[] = {
    {"reconstruct", add_reconstruct, true},
    {"segment", add_segment, true},
    {"info", add_info, true},
    {"compare", add_compare, true},
    {"export", add_export},
    {"replay", add_replay, true},
    {"optimise", add_optimise},
    {"inflate", add_inflate},
    {"options", add_options},
};

const KnownCommand* find_command(std::string_view name) {
  const auto* const found =
      std::find_if(std::begin(kCommands), std::end(kCommands),
                   [&](const KnownCommand& command) { return command.name == name; });
  return found != std::end(kCommands) ? found : nullptr;
}

/// Building a command's flags takes time: only those of the one that is asked for, or all.
void add_commands(CLI::App& app, const KnownCommand* asked, RunFlags& flags, Command& chosen) {
  if (asked != nullptr) {
    if (asked->reads_meshes) use_large_pages();
    return asked->add(app, flags, chosen);
  }
  for (const KnownCommand& command : kCommands) command.add(app, flags, chosen);
}

}  // namespace
}  // namespace hewn

int main(int argc, char** argv) {
  hewn::keep_freed_memory();
  hewn::fetch_first_pages();
  CLI::App app{"Turns triangle meshes of CAD parts back into small, exact, editable CSG trees."};
  app.set_version_flag("--version", "hewn " HEWN_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 failed, 2 usage, 3 input not readable, 4 input not usable,\n"
      "5 output not writable, 130 stopped.");
  hewn::RunFlags flags;
  hewn::Command chosen;
  const std::string_view first = argc > 1 ? argv[1] : "";
  const hewn::KnownCommand* const asked = hewn::find_command(first);
  hewn::add_commands(app, asked, flags, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    const bool is_help = problem.get_exit_code() == 0;
    if (!is_help && asked == nullptr && !first.empty() && first.front() != '-') {
      fmt::print(stderr, "There is no command '{}'; run with --help for those that there are.\n",
                 first);
    } else {
      app.exit(problem);
    }
    return static_cast<int>(is_help ? hewn::ExitCode::Done : hewn::ExitCode::Usage);
  }
  hewn::run_command(chosen, flags);
}
