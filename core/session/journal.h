#pragma once
/// What a session tells its user, and the record of what was done.
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/session/command.h"

namespace hewn {

/// Something to tell the user until they dismiss it.
struct Notice {
  Severity severity = Severity::Info;
  std::string text;
};

/// The place, if any, and the message.
std::string text_of(const Error& error);

class Journal {
 public:
  /// Tells the user, unless the same text still stands there.
  void notify(Severity severity, std::string text);
  /// Only keeps the text; the oldest go when there are too many.
  void note(Severity severity, std::string text);
  /// Tells of an error, which `take_failed` then knows.
  void fail(const Error& error);
  /// Keeps a command that was carried out, also as a line of the log.
  void record(const SessionCommand& command);
  void dismiss(std::size_t notice);

  const std::vector<Notice>& notices() const { return notices_; }
  /// Everything that was told, noted and recorded, oldest first.
  const std::vector<Notice>& entries() const { return entries_; }
  /// The recorded commands, one a line.
  const std::string& log() const { return log_; }
  /// Whether anything failed since the last call.
  bool take_failed() { return std::exchange(has_failed_, false); }

 private:
  std::vector<Notice> notices_, entries_;
  std::string log_;
  bool has_failed_ = false;
};

}  // namespace hewn
