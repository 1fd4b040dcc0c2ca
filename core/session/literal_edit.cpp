#include "core/session/literal_edit.h"

#include <cmath>

#include <fmt/format.h>

#include "core/fit/round_values.h"

namespace hewn {
namespace {

struct FieldRef {
  const char* name;
  double* value;
  bool must_be_positive;
};

/// The fields as places in the literal.
std::vector<FieldRef> field_refs(Literal& literal) {
  std::vector<FieldRef> refs;
  switch (literal.kind) {
    case SolidKind::Box:
      refs = {{"size-x", &literal.size.x(), true},
              {"size-y", &literal.size.y(), true},
              {"size-z", &literal.size.z(), true}};
      break;
    case SolidKind::Cylinder:
      refs = {{"radius", &literal.radius, true}};
      if (literal.radius != literal.top_radius) {
        refs[0].must_be_positive = false;  // a cone's tip
        refs.push_back({"top-radius", &literal.top_radius, false});
      }
      refs.push_back({"height", &literal.height, true});
      break;
    case SolidKind::Prism:
      refs = {{"radius", &literal.radius, true}, {"height", &literal.height, true}};
      break;
    case SolidKind::Sphere:
      refs = {{"radius", &literal.radius, true}};
      break;
    case SolidKind::Torus:
      refs = {{"major-radius", &literal.major_radius, true}, {"radius", &literal.radius, true}};
      break;
    case SolidKind::Polyhedron:
      return refs;
  }
  refs.push_back({"origin-x", &literal.origin.x(), false});
  refs.push_back({"origin-y", &literal.origin.y(), false});
  refs.push_back({"origin-z", &literal.origin.z(), false});
  return refs;
}

}  // namespace

std::vector<LiteralField> literal_fields(const Literal& literal) {
  Literal copy = literal;
  std::vector<LiteralField> fields;
  for (const FieldRef& ref : field_refs(copy)) fields.push_back({ref.name, *ref.value});
  return fields;
}

Result<void> set_literal_field(Literal& literal, std::string_view field, double value) {
  const bool is_straight =
      literal.kind == SolidKind::Cylinder && literal.radius == literal.top_radius;
  for (const FieldRef& ref : field_refs(literal)) {
    if (ref.name != field) continue;
    const bool is_radius = field.ends_with("radius");
    if (!std::isfinite(value) || (ref.must_be_positive && value <= 0) || (is_radius && value < 0)) {
      return Error{ErrorCode::InvalidArgument, fmt::format("{} must be greater than 0", field)};
    }
    *ref.value = value;
    if (is_straight && field == "radius") literal.top_radius = value;
    return {};
  }
  return Error{ErrorCode::InvalidArgument,
               fmt::format("a {} has no '{}'", name_of(literal.kind), field)};
}

Result<void> edit_literals(Tree& tree, const std::vector<LiteralEdit>& edits) {
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const LiteralEdit& edit = edits[i];
    const std::string where = fmt::format("edits[{}]", i);
    if (edit.literal < 0 || static_cast<std::size_t>(edit.literal) >= tree.literals.size()) {
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("there is no literal {}, only 0 to {}", edit.literal,
                               static_cast<int>(tree.literals.size()) - 1),
                   where};
    }
    if (auto done = set_literal_field(tree.literals[edit.literal], edit.field, edit.value); !done) {
      return Error{done.error().code, done.error().message, where};
    }
  }
  return {};
}

double suggested_value(double value, double diagonal) {
  return round_value(value, 2e-3 * diagonal);
}

}  // namespace hewn
