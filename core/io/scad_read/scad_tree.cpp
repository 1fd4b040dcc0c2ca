#include "core/io/scad_read/scad_tree.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/io/scad_prism.h"
#include "core/io/scad_read/scad_matrix.h"
#include "core/io/scad_read/scad_parser.h"
#include "core/io/scad_read/scad_solid.h"

namespace hewn {
namespace {

/// What holds around a node.
struct Place {
  Affine3 map = Affine3::Identity();
  ScadScope scope;
};

class TreeBuilder {
 public:
  TreeBuilder(std::string_view text, const std::string& source, const ScadReadOptions& options,
              const RunContext& run)
      : text_(text), source_(source), options_(options), run_(run) {}

  Result<Tree> run(const ScadDesign& design) {
    for (const ScadModule& m : design.modules) modules_[m.name] = &m;
    Place place;
    place.scope = {design.sides, options_.most_prism_sides};
    tree_.root = operation(Op::Union, design.nodes, place);
    if (fault_) return *fault_;
    if (literal_count(tree_) == 0) {
      return Error{ErrorCode::Format, "the design is empty: there is no solid in it", source_};
    }
    return std::move(tree_);
  }

 private:
  static constexpr int kNothing = -1;

  void fail(Error error) {
    if (!fault_) fault_ = std::move(error);
  }
  void fail(ErrorCode code, const ScadNode& node, std::string message) {
    fail(Error{code, std::move(message), at_place(source_, node.place)});
  }

  int node(const ScadNode& n, const Place& place) {
    if (fault_) return kNothing;
    if (run_.is_cancelled()) {
      fail(RunContext::cancelled());
      return kNothing;
    }
    if (n.name == "union" || n.name == "group" || n.name == "color" || n.name == "render") {
      return operation(Op::Union, n.children, inner(n, place));
    }
    if (n.name == "difference") return operation(Op::Difference, n.children, inner(n, place));
    if (n.name == "intersection") return operation(Op::Intersection, n.children, inner(n, place));
    if (n.name == "echo" && n.children.empty()) return kNothing;
    if (is_transformation(n.name)) return moved(n, place);
    if (const auto m = modules_.find(n.name); m != modules_.end()) {
      return module(n, *m->second, place);
    }
    if (is_solid(n.name)) return solid(n, place);
    return rendered(n, place);
  }

  static Place inner(const ScadNode& n, const Place& place) {
    Place changed = place;
    if (const ScadValue* sides = n.argument("$fn")) changed.scope.sides = *sides;
    return changed;
  }

  /// An operand without a solid is the empty set.
  int operation(Op op, const std::vector<ScadNode>& nodes, const Place& place) {
    std::vector<int> children;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const int child = node(nodes[i], place);
      if (child != kNothing) {
        children.push_back(child);
      } else if (op == Op::Intersection || (op == Op::Difference && i == 0)) {
        return kNothing;
      }
    }
    if (children.empty()) return kNothing;
    return children.size() == 1 ? children[0] : tree_.add_node(op, std::move(children));
  }

  int moved(const ScadNode& n, const Place& place) {
    const auto map = scad_transformation(n, source_);
    if (!map) return fail(map.error()), kNothing;
    Place changed = inner(n, place);
    changed.map = place.map * *map;
    return operation(Op::Union, n.children, changed);
  }

  int module(const ScadNode& n, const ScadModule& m, const Place& place) {
    if (std::find(open_.begin(), open_.end(), m.name) != open_.end()) {
      fail(ErrorCode::Format, n, fmt::format("the module '{}' contains itself", m.name));
      return kNothing;
    }
    if (!n.arguments.empty() || !n.children.empty()) {
      fail(ErrorCode::NotFound, n,
           "a module with parameters can only be read with the help of the program openscad");
      return kNothing;
    }
    open_.push_back(m.name);
    const int made = operation(Op::Union, m.children, place);
    open_.pop_back();
    if (made != kNothing && tree_.nodes[made].name.empty()) tree_.nodes[made].name = m.name;
    return made;
  }

  int solid(const ScadNode& n, const Place& place) {
    const auto made = scad_solid(n, place.scope, source_);
    if (made) return literal(n, *made, place);
    if (made.error().code == ErrorCode::NotFound) return rendered(n, place);
    fail(made.error());
    return kNothing;
  }

  int literal(const ScadNode& n, const Literal& s, const Place& place) {
    if (static_cast<int>(tree_.literals.size()) >= options_.most_literals) {
      fail(ErrorCode::TooLarge, n,
           fmt::format("the design has more than {} primitives, which are too many here; divide it",
                       options_.most_literals));
      return kNothing;
    }
    const Literal there = transformed(s, place.map);
    const Box3 box = there.bounds();
    if (!box.lo.allFinite() || !box.hi.allFinite()) {
      fail(ErrorCode::Format, n, "this solid is not finite");
      return kNothing;
    }
    return tree_.add_literal(there);
  }

  int rendered(const ScadNode& n, const Place& place) {
    if (!options_.render) {
      fail(ErrorCode::NotFound, n,
           fmt::format("'{}' is not understood here and would have to be rendered by the program "
                       "openscad; install it, or replace the construct by primitives",
                       n.name.substr(0, 40)));
      return kNothing;
    }
    std::string text;
    if (const double* sides = place.scope.sides.number()) text = fmt::format("$fn = {};\n", *sides);
    text += text_.substr(n.place.offset, n.end - n.place.offset);
    auto mesh = options_.render(text);
    if (!mesh) {
      Error error = mesh.error();
      error.where = at_place(source_, n.place);
      return fail(std::move(error)), kNothing;
    }
    return literal(n, polyhedron_literal(std::make_shared<const Mesh>(std::move(*mesh))), place);
  }

  std::string_view text_;
  const std::string& source_;
  const ScadReadOptions& options_;
  const RunContext& run_;
  std::map<std::string, const ScadModule*> modules_;
  std::vector<std::string> open_;  ///< modules being expanded
  Tree tree_;
  std::optional<Error> fault_;
};

/// The writer's own module for prisms is known here; blanks keep the places of what follows.
std::string without_prism_module(std::string_view text) {
  std::string rest(text);
  const std::size_t at = rest.find(kPrismModule);
  if (at == std::string::npos) return rest;
  for (std::size_t i = at; i < at + kPrismModule.size(); ++i) {
    if (rest[i] != '\n') rest[i] = ' ';
  }
  return rest;
}

}  // namespace

Result<Tree> tree_from_scad(std::string_view text, const std::string& source,
                            const ScadReadOptions& options, const RunContext& run) {
  const std::string known = without_prism_module(text);
  const auto design = parse_scad(known, source);
  if (!design) return design.error();
  return TreeBuilder(text, source, options, run).run(*design);
}

}  // namespace hewn
