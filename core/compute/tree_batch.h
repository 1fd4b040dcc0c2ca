#pragma once
/// Many candidate trees measured at once on bit columns.
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/compute/device.h"
#include "core/compute/kernels/tree_kernel.h"

namespace hewn {

/// A tree in postfix order: a column's number at or above 0, or one of the operations below. A
/// difference's second operand is the topmost; a complement has one.
using Token = std::int16_t;
inline constexpr Token kUnionToken = -1;
inline constexpr Token kIntersectionToken = -2;
inline constexpr Token kDifferenceToken = -3;
inline constexpr Token kComplementToken = -4;

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
  /// A node of the tree that is being added, by the token that ends it.
  struct Node {
    std::int32_t left = -1;  ///< the operands' last tokens
    std::int32_t right = -1;
    std::int32_t arrays = 0;  ///< work arrays that it needs; 0: a column
  };
  TreeOperand emit(std::span<const Token> tree, std::int32_t node, int first_array);
  void emit_operands(std::span<const Token> tree, const Node& node, int first_array,
                     TreeStep& step);

  std::vector<TreeSpan> trees_;
  std::vector<TreeStep> steps_;
  std::size_t overlap_words_ = 0;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> stack_;
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
