#pragma once
/// What terms that grow from the same open cells have in common.
#include <deque>
#include <vector>

#include "core/compute/pair_counts.h"
#include "core/synth/decompose/open_cells.h"

namespace hewn {

/// What a term keeps of the open cells when it takes a halfspace side.
struct SideWorth {
  CommonCounts kept;
  double gain = 0;  ///< information gained
};

/// Open cells with what has been counted of them.
struct CountedCells {
  OpenCells cells;
  CommonCounts left;  ///< in `cells`
  int side = -1;      ///< the first literal's: twice the halfspace, plus one for inside
  std::vector<SideWorth> sides = {};  ///< by halfspace: of its outside, its inside; or empty
};

/// The open cells before a term's first literal and after each possible one: most of the counting
/// is done there, and few of them differ among terms.
class GrowthStart {
 public:
  /// Requires: `open` and `gained` as for `OpenCells::reset`; `pairs`, if any, has counted these
  /// cells in the insides of all halfspaces, and outlives the use.
  void reset(const ColumnTable& columns, const std::vector<Word>& open,
             const std::vector<Word>* gained, bool fills, const PairCounts* pairs);
  void forget() { is_known_ = false; }
  bool is_known() const { return is_known_; }

  CountedCells& root() { return root_; }
  /// After taking a side of a halfspace first.
  CountedCells& after(std::size_t halfspace, bool inside);
  /// How many of the cells, the root's or those after a literal, the inside of each halfspace
  /// keeps.
  void count_insides(const CountedCells& counted, std::span<const Word* const> insides,
                     std::span<CommonCounts> out) const;

 private:
  const ColumnTable* columns_ = nullptr;
  const PairCounts* pairs_ = nullptr;
  bool is_known_ = false;
  CountedCells root_;
  std::vector<int> child_of_side_;  ///< index into `children_`, -1: not met yet
  std::deque<CountedCells> children_;
  std::size_t children_used_ = 0;
};

}  // namespace hewn
