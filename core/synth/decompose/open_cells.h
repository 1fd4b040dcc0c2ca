#pragma once
/// The cells that a growing term still has to sort out.
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/sample/cells.h"

namespace hewn {

/// Open cells as a term sees them: others must not be covered, the same ones are what it gains.
/// Memory is kept between uses.
class OpenCells {
 public:
  /// The cells in `open`, of which those not in `gained` (if any) count for nothing.
  void reset(const ColumnTable& columns, const std::vector<Word>& open,
             const std::vector<Word>* gained, bool fills);

  /// Those of `all` that are in the column. Cells are in spatial order: most blocks soon hold none
  /// that is left, and are forgotten. `all` may be the cells themselves.
  void take_in(const OpenCells& all, const Word* column);

  /// Whether `narrow(first word, cells)`, which clears bits of a block of cells, leaves none of the
  /// others. Ends with the first block where it does.
  template <class Narrow>
  bool has_no_others_in(const Narrow& narrow) const {
    for (const std::uint32_t block : blocks_) {
      Word cells[kWordBlock];
      std::copy_n(others_.data() + block, kWordBlock, cells);
      narrow(block, cells);
      Word any = 0;
      for (const Word w : cells) any |= w;
      if (any != 0) return false;
    }
    return true;
  }
  /// The cells themselves, right after `reset`.
  std::span<const Word> others() const { return others_; }
  std::span<const Word> same() const { return same_; }
  /// How many are left: others as `a`, the same as `b`.
  CommonCounts count() const;
  /// How many each of the columns would keep.
  void count(std::span<const Word* const> columns, std::span<CommonCounts> out) const;

 private:
  std::vector<Word> others_, same_;    ///< of blocks with bits left; what is in others is stale
  std::vector<std::uint32_t> blocks_;  ///< first words of the blocks with bits left
};

}  // namespace hewn
