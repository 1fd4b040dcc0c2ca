#include "core/session/journal.h"

#include <algorithm>

#include <fmt/format.h>

namespace hewn {
namespace {

constexpr std::size_t kMostEntries = 1000;

}  // namespace

std::string text_of(const Error& error) {
  return error.where.empty() ? error.message : error.where + ": " + error.message;
}

void Journal::notify(Severity severity, std::string text) {
  const bool is_shown = std::any_of(notices_.begin(), notices_.end(),
                                    [&text](const Notice& n) { return n.text == text; });
  note(severity, text);
  if (!is_shown) notices_.push_back({severity, std::move(text)});
}

void Journal::note(Severity severity, std::string text) {
  if (entries_.size() == kMostEntries) entries_.erase(entries_.begin());
  entries_.push_back({severity, std::move(text)});
}

void Journal::fail(const Error& error) {
  has_failed_ = true;
  notify(Severity::Error, text_of(error));
}

void Journal::record(const SessionCommand& command) {
  const std::string line = command_to_line(command);
  log_ += line + "\n";
  note(Severity::Info, fmt::format("{}  {}", title_of(command), line));
}

void Journal::dismiss(std::size_t notice) {
  if (notice < notices_.size()) notices_.erase(notices_.begin() + static_cast<long>(notice));
}

}  // namespace hewn
