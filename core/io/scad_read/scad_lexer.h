#pragma once
/// Words, numbers and marks of an OpenSCAD text.
#include <string>
#include <string_view>

#include "core/io/scad_read/scad_value.h"

namespace hewn {

enum class ScadTokenKind { End, Word, Number, Text, Mark, Bad };

struct ScadToken {
  ScadTokenKind kind = ScadTokenKind::End;
  std::string_view text;  ///< as written; of `Text` without the quotes
  double number = 0;
  ScadPlace place;
  std::string problem;  ///< why it is `Bad`
};

/// Skips blanks and comments.
class ScadLexer {
 public:
  explicit ScadLexer(std::string_view text) : text_(text) {}

  ScadToken next();

 private:
  bool skip_blanks(ScadToken& token);
  void advance(std::size_t count);
  void read_number(ScadToken& token);
  void read_text(ScadToken& token);
  char at(std::size_t ahead) const {
    const std::size_t i = place_.offset + ahead;
    return i < text_.size() ? text_[i] : '\0';
  }

  std::string_view text_;
  ScadPlace place_;
};

}  // namespace hewn
