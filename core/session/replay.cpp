#include "core/session/replay.h"

#include <fmt/format.h>

#include "core/base/file.h"

namespace hewn {
namespace {

Result<void> run_line(std::string_view line, Session& session) {
  auto command = command_from_line(line);
  if (!command) return command.error();
  if (auto done = session.execute(*command); !done) return done;
  session.wait();
  if (!session.take_failed()) return {};
  const std::string& why = session.notices().back().text;
  return Error{ErrorCode::NotFound, fmt::format("{}: {}", title_of(*command), why)};
}

}  // namespace

Result<Replay> replay_log(std::string_view log, const std::string& source, const RunContext& run) {
  RunContext base = run;
  base.on_progress = {};
  Session session(base);
  session.set_views(false);
  Replay out;
  int number = 0;
  for (std::size_t at = 0; at < log.size();) {
    const std::size_t end = std::min(log.find('\n', at), log.size());
    const std::string_view line = log.substr(at, end - at);
    at = end + 1;
    ++number;
    if (line.empty()) continue;
    if (run.is_cancelled()) return RunContext::cancelled();
    if (auto done = run_line(line, session); !done) {
      Error error = done.error();
      error.where =
          fmt::format("{}:{}{}{}", source, number, error.where.empty() ? "" : ", ", error.where);
      return error;
    }
    ++out.commands;
    run.report("replay", static_cast<double>(at) / static_cast<double>(log.size()));
  }
  out.plan = plan_text(session.document().project);
  return out;
}

Result<Replay> replay_file(const std::filesystem::path& path, const RunContext& run) {
  auto log = read_file(path);
  if (!log) return log.error();
  return replay_log(*log, path.string(), run);
}

}  // namespace hewn
