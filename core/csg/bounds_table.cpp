#include "core/csg/bounds_table.h"

#include <cmath>
#include <limits>

namespace hewn {
namespace {

/// Two roundings to single precision, of a bound and of a coordinate beside it.
constexpr double kRounding = 2.0 * std::numeric_limits<float>::epsilon();

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
      block.lo[axis][lane] = static_cast<float>(lo - kRounding * std::abs(lo));
      block.hi[axis][lane] = static_cast<float>(hi + kRounding * std::abs(hi));
    }
  }
}

}  // namespace hewn
