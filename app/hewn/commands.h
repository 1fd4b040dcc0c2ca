#pragma once
/// The commands of `hewn`, one source file each.
#include <functional>

#include <CLI/CLI.hpp>

#include "app/hewn/console.h"
#include "app/hewn/exit_code.h"
#include "app/hewn/flags.h"
#include "app/hewn/interrupt.h"
#include "core/base/run_context.h"

namespace hewn {

/// What a command works with. Lives as long as the process.
struct Environment {
  RunFlags flags;
  RunContext run;
  Interrupt* interrupt = nullptr;
  Console* console = nullptr;

  /// Reports the error and turns it into the exit code.
  ExitCode fail(const Error& error) const {
    console->error(error);
    return exit_code_of(error.code);
  }
};

/// The error with the input's path where it names no place itself.
inline Error with_input(Error error, const std::filesystem::path& input) {
  if (error.where.empty()) error.where = input.string();
  return error;
}

/// A parsed command, ready to run.
using Command = std::function<ExitCode(Environment&)>;

/// Each adds a subcommand to `app`; when the user chose it, parsing stores it in `chosen`.
void add_reconstruct(CLI::App& app, RunFlags& flags, Command& chosen);
void add_segment(CLI::App& app, RunFlags& flags, Command& chosen);
void add_info(CLI::App& app, RunFlags& flags, Command& chosen);
void add_compare(CLI::App& app, RunFlags& flags, Command& chosen);
void add_export(CLI::App& app, RunFlags& flags, Command& chosen);
void add_replay(CLI::App& app, RunFlags& flags, Command& chosen);
void add_optimise(CLI::App& app, RunFlags& flags, Command& chosen);
void add_inflate(CLI::App& app, RunFlags& flags, Command& chosen);
void add_options(CLI::App& app, RunFlags& flags, Command& chosen);

}  // namespace hewn
