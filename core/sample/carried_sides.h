#pragma once
/// On which sides of its literals the points of one arrangement lie, carried over to another.
/// Internal to core/sample.
#include <cstddef>
#include <vector>

#include "core/sample/arrangement.h"

namespace hewn {

/// Reads what two arrangements have in common instead of measuring it again.
class CarriedSides {
 public:
  /// Both must outlive it. Requires: the same scale. Cost: O(literals of one x those of the other).
  CarriedSides(const Arrangement& from, const Arrangement& to);

  /// `classify(to, from.points[cell], signature)`; only the literals that `from` lacks are compared
  /// with the point.
  bool classify(std::size_t cell, Word* signature) const;

 private:
  const Arrangement& from_;
  const Arrangement& to_;
  std::vector<std::size_t> place_;  ///< in `to`, of each literal of `from`; else their number
  std::vector<std::size_t> fresh_;  ///< literals of `to` that `from` lacks
  BoundsTable near_;                ///< of those
};

}  // namespace hewn
