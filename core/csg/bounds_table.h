#pragma once
/// Which of many literals are near a point or on a line: one quick look at all their bounds.
#include <array>
#include <bit>
#include <limits>
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

  /// The same for every literal that the whole line through `origin` comes near. Cost: some 8 ns
  /// for eight of them. Requires: `direction` is not zero.
  template <class Visit>
  void visit_met(const Vec3& origin, const Vec3& direction, const Visit& visit) const {
    const Line line(origin, direction, farthest_);
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      for (unsigned rest = blocks_[block].met(line); rest != 0; rest &= rest - 1) {
        visit(block * kBlock + static_cast<std::size_t>(std::countr_zero(rest)));
      }
    }
  }

 private:
  static constexpr int kBlock = 8;

  using Lanes = Eigen::Array<float, kBlock, 1>;

  struct Line {
    std::array<float, 3> origin, inverse;
    float margin;  ///< more than rounding moves the line or a bound that it meets

    Line(const Vec3& from, const Vec3& along, double farthest);
  };

  /// Bit k: lane k is no more than 0.
  static unsigned none_above(const Lanes& lanes) {
    if (lanes.minCoeff() > 0) return 0;
    unsigned mask = 0;
    for (unsigned k = 0; k < kBlock; ++k) mask |= (lanes[k] <= 0 ? 1U : 0U) << k;
    return mask;
  }

  /// Eight literals side by side, which one instruction compares at once.
  struct Block {
    std::array<Lanes, 3> lo, hi;

    /// Bit k: literal k of the block is near.
    unsigned near(const std::array<float, 3>& p) const {
      Lanes beyond = (lo[0] - p[0]).max(p[0] - hi[0]);
      beyond = beyond.max(lo[1] - p[1]).max(p[1] - hi[1]);
      beyond = beyond.max(lo[2] - p[2]).max(p[2] - hi[2]);
      return none_above(beyond);
    }

    /// Bit k: literal k of the block is met.
    unsigned met(const Line& line) const {
      // What holds nothing is met by nothing.
      Lanes enter = (lo[0] <= hi[0]).select(Lanes::Constant(kLeast), Lanes::Constant(kNever));
      Lanes leave = Lanes::Constant(kMost);
      for (std::size_t k = 0; k < 3; ++k) {
        const Lanes a = (lo[k] - (line.origin[k] + line.margin)) * line.inverse[k];
        const Lanes b = (hi[k] - (line.origin[k] - line.margin)) * line.inverse[k];
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
      }
      return none_above(enter - leave);
    }
  };
  static constexpr float kMost = std::numeric_limits<float>::max();
  static constexpr float kLeast = std::numeric_limits<float>::lowest();
  static constexpr float kNever = std::numeric_limits<float>::infinity();

  std::vector<Block> blocks_;
  double farthest_ = 0;  ///< bound from the coordinates' origin
};

}  // namespace hewn
