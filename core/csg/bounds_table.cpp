#include "core/csg/bounds_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hewn {
namespace {

/// Two roundings to single precision, of a bound and of a coordinate beside it.
constexpr double kRounding = 2.0 * std::numeric_limits<float>::epsilon();
/// Those of a coordinate, of its difference from a bound, and of their quotient by a direction.
constexpr double kLineRounding = 4.0 * std::numeric_limits<float>::epsilon();
/// Components of directions that are smaller count as this one: along a line no longer than what
/// rounding leaves of it they go nowhere.
constexpr double kSmallestComponent = 1e-30;

}  // namespace

BoundsTable::BoundsTable(std::span<const LiteralBounds> bounds, std::span<const double> reach) {
  Block nothing;
  for (int axis = 0; axis < 3; ++axis) {
    nothing.lo[axis].setConstant(std::numeric_limits<float>::infinity());
    nothing.hi[axis].setConstant(-std::numeric_limits<float>::infinity());
  }
  blocks_.assign((bounds.size() + kBlock - 1) / kBlock, nothing);
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    Block& block = blocks_[k / kBlock];
    const auto lane = static_cast<Eigen::Index>(k % kBlock);
    const LiteralBounds& b = bounds[k];
    for (int axis = 0; axis < 3; ++axis) {
      const double lo = b.box.lo[axis] - b.slack - reach[k];
      const double hi = b.box.hi[axis] + b.slack + reach[k];
      for (const double bound : {lo, hi}) {
        if (std::isfinite(bound)) farthest_ = std::max(farthest_, std::abs(bound));
      }
      block.lo[axis][lane] = static_cast<float>(lo - kRounding * std::abs(lo));
      block.hi[axis][lane] = static_cast<float>(hi + kRounding * std::abs(hi));
    }
  }
}

BoundsTable::Line::Line(const Vec3& from, const Vec3& along, double farthest)
    : margin(static_cast<float>(kLineRounding * (from.lpNorm<Eigen::Infinity>() + farthest))) {
  const Vec3 direction = along / along.lpNorm<Eigen::Infinity>();
  for (int axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    const auto k = static_cast<std::size_t>(axis);
    origin[k] = static_cast<float>(from[axis]);
    inverse[k] =
        static_cast<float>(1 / std::copysign(std::max(std::abs(d), kSmallestComponent), d));
  }
}

}  // namespace hewn
