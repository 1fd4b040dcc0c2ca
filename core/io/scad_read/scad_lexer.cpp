#include "core/io/scad_read/scad_lexer.h"

#include <charconv>
#include <cmath>

namespace hewn {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_word_start(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
}
bool is_word(char c) { return is_word_start(c) || is_digit(c); }

}  // namespace

void ScadLexer::advance(std::size_t count) {
  for (std::size_t i = 0; i < count && place_.offset < text_.size(); ++i, ++place_.offset) {
    if (text_[place_.offset] == '\n') {
      ++place_.line;
      place_.column = 1;
    } else {
      ++place_.column;
    }
  }
}

/// False when a comment does not end; `token` then says so.
bool ScadLexer::skip_blanks(ScadToken& token) {
  while (place_.offset < text_.size()) {
    const char c = at(0);
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
      advance(1);
    } else if (c == '/' && at(1) == '/') {
      while (place_.offset < text_.size() && at(0) != '\n') advance(1);
    } else if (c == '/' && at(1) == '*') {
      token.place = place_;
      const std::size_t end = text_.find("*/", place_.offset + 2);
      if (end == std::string_view::npos) {
        token.kind = ScadTokenKind::Bad;
        token.problem = "this comment is never closed; add */";
        return false;
      }
      advance(end + 2 - place_.offset);
    } else {
      break;
    }
  }
  return true;
}

void ScadLexer::read_number(ScadToken& token) {
  const char* begin = text_.data() + place_.offset;
  const auto [end, fault] = std::from_chars(begin, text_.data() + text_.size(), token.number);
  auto length = static_cast<std::size_t>(end - begin);
  if (fault != std::errc() || !std::isfinite(token.number) || is_word_start(at(length))) {
    token.kind = ScadTokenKind::Bad;
    token.problem = "this is no finite number";
    length = std::max<std::size_t>(1, length);
  } else {
    token.kind = ScadTokenKind::Number;
  }
  token.text = text_.substr(place_.offset, length);
  advance(length);
}

void ScadLexer::read_text(ScadToken& token) {
  std::size_t length = 1;
  while (at(length) != '"' && place_.offset + length < text_.size()) {
    length += at(length) == '\\' ? 2 : 1;
  }
  if (place_.offset + length >= text_.size()) {
    token.kind = ScadTokenKind::Bad;
    token.problem = "this string is never closed; add \"";
    return;
  }
  token.kind = ScadTokenKind::Text;
  token.text = text_.substr(place_.offset + 1, length - 1);
  advance(length + 1);
}

ScadToken ScadLexer::next() {
  ScadToken token;
  if (!skip_blanks(token)) return token;
  token.place = place_;
  if (place_.offset >= text_.size()) return token;
  const char c = at(0);
  if (is_digit(c) || (c == '.' && is_digit(at(1)))) {
    read_number(token);
  } else if (is_word_start(c)) {
    std::size_t length = 1;
    while (is_word(at(length))) ++length;
    token.kind = ScadTokenKind::Word;
    token.text = text_.substr(place_.offset, length);
    advance(length);
  } else if (c == '"') {
    read_text(token);
  } else if (std::string_view("(){}[];,=+-*/%#!<>?:.&|^").find(c) != std::string_view::npos) {
    token.kind = ScadTokenKind::Mark;
    token.text = text_.substr(place_.offset, 1);
    advance(1);
  } else {
    token.kind = ScadTokenKind::Bad;
    token.problem = "this character has no meaning in OpenSCAD";
  }
  return token;
}

}  // namespace hewn
