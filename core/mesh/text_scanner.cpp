#include "core/mesh/text_scanner.h"

#include <charconv>
#include <cstdlib>

#include <fmt/format.h>

namespace hewn {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

void skip_blanks(std::string_view& text) {
  std::size_t n = 0;
  while (n < text.size() && is_blank(text[n])) ++n;
  text.remove_prefix(n);
}

}  // namespace

bool TextScanner::next_line() {
  while (!rest_.empty()) {
    std::size_t end = rest_.find('\n');
    // Old Macintosh files end lines with a lone carriage return.
    const std::size_t lone = rest_.substr(0, end).find('\r');
    if (lone != std::string_view::npos && lone + 1 < std::min(end, rest_.size())) end = lone;
    current_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
    current_ = current_.substr(0, current_.find(comment_));
    if (!at_line_end()) return true;
  }
  current_ = {};
  return false;
}

bool TextScanner::at_line_end() {
  skip_blanks(current_);
  return current_.empty();
}

std::string_view TextScanner::field() {
  skip_blanks(current_);
  std::size_t n = 0;
  while (n < current_.size() && !is_blank(current_[n])) ++n;
  const std::string_view found = current_.substr(0, n);
  current_.remove_prefix(n);
  return found;
}

std::optional<double> parse_double(std::string_view field) {
  if (!field.empty() && field.front() == '+') field.remove_prefix(1);
  double value = 0;
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (stop != end || field.empty()) return std::nullopt;
  // 1e999 or 1e-999: strtod tells infinity from zero.
  if (error == std::errc::result_out_of_range)
    return std::strtod(std::string(field).c_str(), nullptr);
  if (error != std::errc()) return std::nullopt;
  return value;
}

std::optional<long long> parse_integer(std::string_view field) {
  if (!field.empty() && field.front() == '+') field.remove_prefix(1);
  long long value = 0;
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (stop != end || error != std::errc() || field.empty()) return std::nullopt;
  return value;
}

std::string quote_field(std::string_view field) {
  std::string text = "'";
  for (const char c : field.substr(0, 20)) text += (c >= 32 && c < 127) ? c : '?';
  return text + (field.size() > 20 ? "...'" : "'");
}

bool read_point(TextScanner& scanner, Vec3& point, std::string& found) {
  for (double& c : point) {
    const std::string_view field = scanner.field();
    const auto value = parse_double(field);
    if (!value) {
      found = field.empty() ? "the end of the line" : quote_field(field);
      return false;
    }
    c = *value;
  }
  return true;
}

std::string at_line(const std::string& name, int line) { return fmt::format("{}:{}", name, line); }

}  // namespace hewn
