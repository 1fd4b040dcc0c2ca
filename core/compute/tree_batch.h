#pragma once
/// Many candidate trees measured at once on bit columns.
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/compute/device.h"
#include "core/compute/kernels/tree_steps.h"

namespace hewn {

/// What is measured of a tree.
struct TreeMeasures {
  int held = 0;         ///< rows that it holds
  int held_wanted = 0;  ///< of those, rows that it should hold
  int overlaps = 0;     ///< operations whose operands have a row in common
};

/// Trees, translated to the steps that `TreeKernel` takes.
class TreeBatch {
 public:
  /// Requires: a complete formula of at most 2^15 leaves; less than 2^31 nodes in all.
  /// Cost: O(nodes).
  void add(std::span<const Token> tree);
  void clear();

  std::size_t size() const { return trees_.size(); }
  std::span<const TreeSpan> trees() const { return trees_; }
  std::span<const TreeStep> steps() const { return steps_; }
  std::size_t overlap_words() const { return overlap_words_; }

 private:
  std::vector<TreeSpan> trees_;
  std::vector<TreeStep> steps_;
  std::size_t overlap_words_ = 0;
  std::vector<TreeNode> nodes_;       ///< of the tree that is being added
  std::vector<PendingNode> pending_;  ///< of those
};

/// The rows on which trees are measured, kept on the device that measured last. One thread.
class MeasuredRows {
 public:
  /// All columns have `padded_words(rows)` words, zero beyond the last row.
  /// Requires: fewer than 2^31 rows, at most 2^15 columns.
  MeasuredRows(std::size_t rows, const std::vector<std::vector<Word>>& columns,
               const std::vector<Word>& wanted);

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }

  /// Measures every tree; the same numbers on every device.
  /// Requires: `out.size() == batch.size()`; the trees' columns exist.
  /// Fails with: the device's errors, Cancelled.
  /// Cost: O(steps x words), in parts that fit into the device's memory.
  Result<void> measure(Device& device, const TreeBatch& batch, std::span<TreeMeasures> out,
                       const RunContext& run);

  /// Estimate for `Compute::run`: measured on one core (docs/performance.md).
  double seconds_for(const TreeBatch& batch) const {
    return 1e-7 * static_cast<double>(batch.size()) +
           2.5e-10 * static_cast<double>(batch.steps().size()) * static_cast<double>(words_);
  }

 private:
  /// A range of words, and the columns' bits in it on the device.
  struct Part {
    std::size_t begin = 0, words = 0;
    const Word* bits = nullptr;
  };
  std::size_t words_per_part(const Device& device) const;
  DeviceBuffer<Word> upload_part(DeviceJob& job, std::size_t begin, std::size_t words) const;
  TreeMeasures measures_of(const TreeSpan& tree, const TreeCounts& counts) const;
  Result<void> measure_part(Device& device, const TreeBatch& batch, const Part& part,
                            const RunContext& run);

  std::size_t rows_, words_, columns_;
  std::vector<Word> bits_;  ///< the columns, then the wanted one, then that of all rows
  DeviceBuffer<Word> resident_;
  /// Of the last batch. Kept, since fresh memory costs more than what is put there.
  std::vector<TreeCounts> counts_;
  std::vector<OverlapWord> overlaps_;
};

}  // namespace hewn
