#pragma once
/// Which of many literals are near a point: one quick look at all their bounds.
#include <array>
#include <bit>
#include <span>
#include <vector>

#include "core/csg/literal_bounds.h"

namespace hewn {

/// The bounds of literals, each grown by a reach of its own, in single precision rounded outward.
class BoundsTable {
 public:
  BoundsTable() = default;
  /// `reach[k]`: how far from literal k's bounds a point may lie to be near it.
  BoundsTable(std::span<const LiteralBounds> bounds, std::span<const double> reach);

  /// Calls `visit(k)` for every literal that `p` is near, ascending, and perhaps for a few that it
  /// is just not; ends when it returns false. Cost: O(literals), some 2 ns for eight of them.
  template <class Visit>
  void visit_near(const Vec3& p, const Visit& visit) const {
    const std::array<float, 3> at = {static_cast<float>(p.x()), static_cast<float>(p.y()),
                                     static_cast<float>(p.z())};
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      for (unsigned rest = blocks_[block].near(at); rest != 0; rest &= rest - 1) {
        if (!visit(block * kBlock + static_cast<std::size_t>(std::countr_zero(rest)))) return;
      }
    }
  }

 private:
  static constexpr int kBlock = 8;

  using Lanes = Eigen::Array<float, kBlock, 1>;

  /// Eight literals side by side, which one instruction compares at once.
  struct Block {
    std::array<Lanes, 3> lo, hi;

    /// Bit k: literal k of the block is near.
    unsigned near(const std::array<float, 3>& p) const {
      Lanes beyond = (lo[0] - p[0]).max(p[0] - hi[0]);
      beyond = beyond.max(lo[1] - p[1]).max(p[1] - hi[1]);
      beyond = beyond.max(lo[2] - p[2]).max(p[2] - hi[2]);
      if (beyond.minCoeff() > 0) return 0;
      unsigned mask = 0;
      for (unsigned k = 0; k < kBlock; ++k) mask |= (beyond[k] <= 0 ? 1U : 0U) << k;
      return mask;
    }
  };

  std::vector<Block> blocks_;
};

}  // namespace hewn
