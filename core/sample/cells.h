#pragma once
/// Cells: the distinct sign signatures among the samples, and the bit columns over them.
#include <vector>

#include "core/compute/bits.h"
#include "core/sample/sample_table.h"

namespace hewn {

/// Points with the same signature cannot be told apart by any tree over the halfspaces.
struct Cells {
  std::vector<int> first_point;   ///< a representative per cell, in order of first appearance
  std::vector<int> inside_count;  ///< points labelled inside, per cell
  std::vector<int> outside_count;
  std::vector<int> cell_of_point;

  std::size_t size() const { return first_point.size(); }
  /// Points in the minority of their cell: no tree can classify them.
  long conflicting_points() const;
};

/// Cost: O(points x stride).
Cells find_cells(const SampleTable& table, const RunContext& run);
/// On one core.
Cells find_cells(const SampleTable& table);

/// One bit per kept cell, in an order that keeps neighbours together. All columns have `words`
/// words, zero beyond the last cell.
class ColumnTable {
 public:
  enum class Labels { Noisy, Exact };

  /// Of noisy labels, leaves out cells without a clear majority, and single stray points of large
  /// tables; of exact ones, the cells with both labels.
  ColumnTable(const SampleTable& table, const Cells& cells, Labels labels = Labels::Noisy);

  std::size_t cells() const { return cells_; }
  std::size_t words() const { return words_; }
  std::size_t halfspaces() const { return halfspaces_; }
  /// Cells inside (or outside) a halfspace.
  const Word* column(std::size_t halfspace, bool inside) const {
    return columns_.data() + (2 * halfspace + (inside ? 1 : 0)) * words_;
  }
  const std::vector<Word>& wanted() const { return wanted_; }  ///< cells that the solid fills
  const std::vector<Word>& all() const { return all_; }        ///< every kept cell
  /// Index of the kept cell, -1 when it was left out.
  int kept_index(int cell) const { return kept_index_[cell]; }

  /// Face groups with sample pairs; each has up to 64 of them.
  std::size_t groups() const { return pair_masks_.size(); }
  Word pair_mask(std::size_t group) const { return pair_masks_[group]; }
  /// The pairs of a group whose inside (end 0) or outside (end 1) point lies on a side.
  Word pair_word(std::size_t halfspace, bool inside, std::size_t group, int end) const {
    return pair_words_[((2 * halfspace + (inside ? 1 : 0)) * groups() + group) * 2 +
                       static_cast<std::size_t>(end)];
  }

 private:
  void fill_pairs(const SampleTable& table);

  std::size_t cells_ = 0, words_ = 0, halfspaces_ = 0;
  std::vector<Word> columns_, wanted_, all_;
  std::vector<int> kept_index_;
  std::vector<Word> pair_masks_, pair_words_;
};

}  // namespace hewn
