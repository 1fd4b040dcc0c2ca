#pragma once
/// The numbers of a literal, as an inspector shows and changes them.
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/csg/tree.h"

namespace hewn {

/// Gives a number of a found literal another value. Counts literals as the tree lists them before
/// any edit; edits keep the tree's shape.
struct LiteralEdit {
  int literal = 0;
  std::string field;  ///< a name that `literal_fields` gives
  double value = 0;
};

struct LiteralField {
  const char* name = "";  ///< "radius", "height", "size-x", "origin-z", ...
  double value = 0;       ///< model units
};

/// What can be changed, in a fixed order; empty for polyhedra. A frustum has two radii. Origins are
/// along the literal's own axes.
std::vector<LiteralField> literal_fields(const Literal& literal);

/// Fails with InvalidArgument: no such field, a size that is not positive, not finite.
Result<void> set_literal_field(Literal& literal, std::string_view field, double value);

/// Carries out the edits in order. Fails with InvalidArgument: as `set_literal_field`, or no such
/// literal.
Result<void> edit_literals(Tree& tree, const std::vector<LiteralEdit>& edits);

/// A rounder value within 0.2 % of the part's diagonal; `value` itself when there is none.
double suggested_value(double value, double diagonal);

}  // namespace hewn
