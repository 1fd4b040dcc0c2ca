#include "core/io/scad_read/scad_parser.h"

#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/io/scad_read/scad_lexer.h"

namespace hewn {

std::optional<Vec3> ScadValue::vector(double missing) const {
  const auto* items = list();
  if (!items || items->size() < 2 || items->size() > 3) return std::nullopt;
  Vec3 v(0, 0, missing);
  for (std::size_t i = 0; i < items->size(); ++i) {
    const double* x = (*items)[i].number();
    if (!x) return std::nullopt;
    v[static_cast<Eigen::Index>(i)] = *x;
  }
  return v;
}

const ScadValue* ScadNode::argument(std::string_view wanted, int position) const {
  int seen = 0;
  const ScadValue* positional = nullptr;
  for (const ScadArgument& a : arguments) {
    if (!a.name.empty() && a.name == wanted) return &a.value;
    if (a.name.empty() && seen++ == position) positional = &a.value;
  }
  return positional;
}

std::string at_place(const std::string& source, const ScadPlace& place) {
  return fmt::format("{}:{}:{}", source, place.line, place.column);
}

namespace {

/// Recursive descent; the first fault is kept and stops the rest.
class ScadParser {
 public:
  ScadParser(std::string_view text, std::string source) : lexer_(text), source_(std::move(source)) {
    step();
  }

  Result<ScadDesign> run() {
    while (!fault_ && token_.kind != ScadTokenKind::End) statement(design_.nodes, true, 0);
    if (fault_) return *fault_;
    return std::move(design_);
  }

 private:
  void fail(ErrorCode code, const ScadPlace& place, std::string message) {
    if (fault_) return;
    fault_ = Error{code, std::move(message), at_place(source_, place)};
    token_.kind = ScadTokenKind::End;
  }
  void wrong(std::string message) { fail(ErrorCode::Format, token_.place, std::move(message)); }
  void needs_openscad(const ScadPlace& place, std::string_view what) {
    fail(ErrorCode::NotFound, place,
         fmt::format("{} can only be read with the help of the program openscad; install it, or "
                     "export the design as .csg there",
                     what));
  }

  void step() {
    if (fault_) return;
    end_ = token_.place.offset + token_.text.size();
    token_ = lexer_.next();
    if (token_.kind == ScadTokenKind::Bad) wrong(token_.problem);
  }

  bool is_mark(char c) const { return token_.kind == ScadTokenKind::Mark && token_.text[0] == c; }
  bool take(char c) {
    if (!is_mark(c)) return false;
    step();
    return true;
  }
  void expect(char c, const char* after) {
    if (take(c) || fault_) return;
    const std::string found = token_.kind == ScadTokenKind::End
                                  ? "the text ends"
                                  : fmt::format("'{}' stands", token_.text.substr(0, 20));
    wrong(fmt::format("{} where '{}' is needed after {}", found, c, after));
  }

  /// One instantiation, module, assignment or empty statement.
  void statement(std::vector<ScadNode>& out, bool is_top, int depth) {
    if (depth > kDeepestScad) {
      return fail(
          ErrorCode::TooLarge, token_.place,
          fmt::format("blocks are nested deeper than {}; flatten the design", kDeepestScad));
    }
    if (take(';')) return;
    bool is_dropped = false;
    while (is_mark('*') || is_mark('%') || is_mark('#') || is_mark('!')) {
      if (is_mark('!')) return needs_openscad(token_.place, "the modifier '!'");
      is_dropped = is_dropped || !is_mark('#');
      step();
    }
    if (is_mark('{')) {
      ScadNode group;
      group.name = "group";
      group.place = token_.place;
      body(group.children, depth);
      group.end = end_;
      return keep(std::move(group), is_dropped, out);
    }
    if (token_.kind != ScadTokenKind::Word) {
      return wrong(token_.kind == ScadTokenKind::End
                       ? "the text ends within a block; a '}' is missing"
                       : fmt::format("'{}' cannot start a statement", token_.text.substr(0, 20)));
    }
    const ScadToken word = token_;
    step();
    if (word.text == "module") return module(is_top, word.place);
    if (word.text == "use" || word.text == "include" || word.text == "function" ||
        word.text == "for" || word.text == "if" || word.text == "let" ||
        word.text == "intersection_for" || word.text == "assign" || word.text == "each") {
      return needs_openscad(word.place, fmt::format("'{}'", word.text));
    }
    if (is_mark('=')) return assignment(word, is_top);
    ScadNode node;
    instantiation(word, node, depth);
    keep(std::move(node), is_dropped, out);
  }

  void keep(ScadNode node, bool is_dropped, std::vector<ScadNode>& out) {
    if (fault_ || is_dropped) return;
    if (++count_ > kMostScadNodes) {
      return fail(ErrorCode::TooLarge, node.place,
                  fmt::format("the design has more than {} objects", kMostScadNodes));
    }
    out.push_back(std::move(node));
  }

  void instantiation(const ScadToken& word, ScadNode& node, int depth) {
    node.name = word.text;
    node.place = word.place;
    expect('(', "a name");
    while (!fault_ && !is_mark(')')) {
      node.arguments.push_back(argument());
      if (!is_mark(')')) expect(',', "an argument");
    }
    expect(')', "the arguments");
    if (is_mark('{')) {
      body(node.children, depth);
    } else if (!take(';') && !fault_) {
      statement(node.children, false, depth + 1);
    }
    node.end = end_;
  }

  void body(std::vector<ScadNode>& out, int depth) {
    expect('{', "a name");
    while (!fault_ && !is_mark('}')) statement(out, false, depth + 1);
    expect('}', "a block");
  }

  void module(bool is_top, const ScadPlace& place) {
    if (!is_top) return needs_openscad(place, "a module within a block");
    ScadModule made;
    made.place = token_.place;
    if (token_.kind != ScadTokenKind::Word) return wrong("a module needs a name");
    made.name = token_.text;
    step();
    expect('(', "a module's name");
    if (!fault_ && !is_mark(')')) return needs_openscad(place, "a module with parameters");
    expect(')', "a module's name");
    body(made.children, 0);
    for (const ScadModule& other : design_.modules) {
      if (other.name == made.name) return needs_openscad(made.place, "a module defined twice");
    }
    if (!fault_) design_.modules.push_back(std::move(made));
  }

  void assignment(const ScadToken& word, bool is_top) {
    if (!is_top) return needs_openscad(word.place, "an assignment within a block");
    step();
    ScadValue value = expression(0);
    expect(';', "an assignment");
    if (fault_) return;
    if (word.text == "$fn") {
      design_.sides = value;
    } else if (word.text[0] == '$') {
      return;  // resolution and view settings do not change true circles
    } else if (!constants_.try_emplace(std::string(word.text), std::move(value)).second) {
      needs_openscad(word.place, "a constant that is assigned twice");
    }
  }

  ScadArgument argument() {
    ScadArgument a;
    if (token_.kind == ScadTokenKind::Word) {
      const ScadToken word = token_;
      step();
      if (take('=')) {
        a.name = word.text;
        a.value = expression(0);
        return a;
      }
      a.value = rest_of_sum(rest_of_product(named(word), 0), 0);
      return a;
    }
    a.value = expression(0);
    return a;
  }

  ScadValue expression(int depth) {
    if (depth > kDeepestScad) {
      fail(ErrorCode::TooLarge, token_.place, "the expression is nested too deep");
      return {};
    }
    ScadValue value = rest_of_sum(product(depth), depth);
    if (is_mark('?') || is_mark('<') || is_mark('>') || is_mark('&') || is_mark('|') ||
        is_mark('=') || is_mark('!')) {
      needs_openscad(token_.place, "a condition");
    }
    return value;
  }

  ScadValue rest_of_sum(ScadValue left, int depth) {
    while (is_mark('+') || is_mark('-')) {
      const char op = token_.text[0];
      const ScadPlace place = token_.place;
      step();
      left = combined(op, left, product(depth), place);
    }
    return left;
  }

  ScadValue product(int depth) { return rest_of_product(unary(depth), depth); }

  ScadValue rest_of_product(ScadValue left, int depth) {
    while (is_mark('*') || is_mark('/') || is_mark('%') || is_mark('^')) {
      const char op = token_.text[0];
      const ScadPlace place = token_.place;
      step();
      left = combined(op, left, unary(depth), place);
    }
    return left;
  }

  ScadValue combined(char op, const ScadValue& a, const ScadValue& b, const ScadPlace& place) {
    const double* x = a.number();
    const double* y = b.number();
    if (!x || !y || op == '%' || op == '^') {
      needs_openscad(place, "this arithmetic");
      return {};
    }
    const double value = op == '+' ? *x + *y : op == '-' ? *x - *y : op == '*' ? *x * *y : *x / *y;
    if (!std::isfinite(value)) {
      fail(ErrorCode::Format, place, "the result of this arithmetic is not finite");
    }
    return {value};
  }

  ScadValue unary(int depth) {
    if (depth > kDeepestScad) {
      fail(ErrorCode::TooLarge, token_.place, "the expression is nested too deep");
      return {};
    }
    if (take('+')) return unary(depth + 1);
    if (!is_mark('-')) return primary(depth);
    const ScadPlace place = token_.place;
    step();
    return combined('-', {0.0}, unary(depth + 1), place);
  }

  ScadValue primary(int depth) {
    if (token_.kind == ScadTokenKind::Number) {
      const double value = token_.number;
      step();
      return {value};
    }
    if (token_.kind == ScadTokenKind::Text) {
      std::string value(token_.text);
      step();
      return {std::move(value)};
    }
    if (token_.kind == ScadTokenKind::Word) {
      const ScadToken word = token_;
      step();
      return named(word);
    }
    if (take('(')) {
      ScadValue value = expression(depth + 1);
      expect(')', "an expression");
      return value;
    }
    if (is_mark('[')) return vector(depth);
    wrong(token_.kind == ScadTokenKind::End
              ? "the text ends where a value is needed"
              : fmt::format("'{}' stands where a value is needed", token_.text.substr(0, 20)));
    return {};
  }

  ScadValue vector(int depth) {
    step();
    std::vector<ScadValue> items;
    while (!fault_ && !is_mark(']')) {
      items.push_back(expression(depth + 1));
      if (is_mark(':')) needs_openscad(token_.place, "a range");
      if (!is_mark(']')) expect(',', "a value");
    }
    expect(']', "a vector");
    return {std::move(items)};
  }

  ScadValue named(const ScadToken& word) {
    if (word.text == "true") return {true};
    if (word.text == "false") return {false};
    if (word.text == "undef") return {};
    if (word.text == "PI") return {kPi};
    if (word.text == "nan" || word.text == "inf" || word.text == "NaN") {
      fail(ErrorCode::Format, word.place, "this is no finite number");
      return {};
    }
    if (is_mark('(')) {
      needs_openscad(word.place, fmt::format("the function '{}'", word.text.substr(0, 40)));
      return {};
    }
    const auto known = constants_.find(std::string(word.text));
    if (known != constants_.end()) return known->second;
    needs_openscad(word.place,
                   fmt::format("'{}', which has no value here,", word.text.substr(0, 40)));
    return {};
  }

  ScadLexer lexer_;
  std::string source_;
  ScadToken token_;
  std::size_t end_ = 0;
  std::size_t count_ = 0;
  ScadDesign design_;
  std::map<std::string, ScadValue> constants_;
  std::optional<Error> fault_;
};

}  // namespace

Result<ScadDesign> parse_scad(std::string_view text, const std::string& source) {
  return ScadParser(text, source).run();
}

}  // namespace hewn
