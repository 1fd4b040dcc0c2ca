#pragma once
/// Line-wise reading of numbers from text that is already in memory. Internal to core/mesh.
#include <optional>
#include <string>
#include <string_view>

#include "core/base/math.h"

namespace hewn {

/// Walks over lines; within a line, over fields separated by blanks. Keeps the line number.
class TextScanner {
 public:
  /// `comment` starts a comment that runs to the end of the line.
  explicit TextScanner(std::string_view text, char comment = '#', int first_line = 1)
      : rest_(text), comment_(comment), line_(first_line - 1) {}

  /// Goes to the next line that holds a field; false at the end of the text.
  bool next_line();
  /// The next field of the line; empty when there is none.
  std::string_view field();
  /// True when the line has no further field.
  bool at_line_end();
  int line() const { return line_; }

 private:
  std::string_view rest_;
  std::string_view current_;
  char comment_;
  int line_;
};

/// The whole field as a number; infinities and NaN are numbers. Independent of the locale.
std::optional<double> parse_double(std::string_view field);
std::optional<long long> parse_integer(std::string_view field);

/// A field for a message: quoted, cut to 20 characters, without control characters.
std::string quote_field(std::string_view field);

/// Reads three numbers. False at the first field that is none: `found` then names it for a message.
bool read_point(TextScanner& scanner, Vec3& point, std::string& found);

/// "path:line".
std::string at_line(const std::string& name, int line);

}  // namespace hewn
