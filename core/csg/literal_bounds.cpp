#include "core/csg/literal_bounds.h"

namespace hewn {
namespace {

constexpr double kRounding = 1e-9;  ///< share of the diagonal
constexpr double kAlongAxis = 1 - 1e-15;

bool fills_bounds(const Literal& literal) {
  return literal.kind == SolidKind::Box && !literal.stretch &&
         literal.rotation.cwiseAbs().colwise().maxCoeff().minCoeff() >= kAlongAxis;
}

}  // namespace

LiteralBounds::LiteralBounds(const Literal& literal)
    : box(literal.bounds()), slack(kRounding * box.diagonal()), is_filled(fills_bounds(literal)) {}

}  // namespace hewn
