#pragma once
/// How good a creature is: geometry, size and proximity in one pass over bit columns.
#include "core/synth/evolve/genome.h"

namespace hewn {

/// What is measured of a tree.
struct Measures {
  int inside_right = 0;   ///< rows to hold that it holds
  int outside_right = 0;  ///< rows to leave out that it leaves out
  int size = 0;           ///< nodes
  int proximity = 0;      ///< P(T); divided by the size it is the proximity
};

/// Memory of one thread; keeps measuring free of allocations.
struct FitnessScratch {
  std::vector<Word> slots;
  std::vector<const Word*> stack;
};

/// The rows on which creatures are judged; those that do not matter are left out.
class FitnessTable {
 public:
  /// Rows are the cells of `care`; `wanted` tells which of them to hold.
  FitnessTable(const CellColumns& cells, const Column& wanted, const Column& care);

  int literals() const { return static_cast<int>(columns_.size()); }
  int inside_rows() const { return inside_; }
  int outside_rows() const { return outside_; }

  /// The same numbers on every processor. Cost: O(nodes x words), without allocation once `scratch`
  /// has grown.
  Measures measure(const Genome& genome, FitnessScratch& scratch) const;

 private:
  std::size_t words_ = 0;
  std::vector<Column> columns_;
  Column wanted_, all_;
  int inside_ = 0, outside_ = 0;
};

}  // namespace hewn
