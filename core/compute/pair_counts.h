#pragma once
/// What pairs of columns have in common with two sets.
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/compute/bits.h"
#include "core/compute/device.h"

namespace hewn {

/// Columns, kept on the device that counted last, and the counts. For one thread at a time.
class PairCounts {
 public:
  /// All columns have `words` words, and outlive it. Requires: fewer than 2^15 columns.
  PairCounts(std::vector<const Word*> columns, std::size_t words)
      : columns_(std::move(columns)), words_(words) {}

  /// Counts the bits of `a` and of `b` that lie in both columns of each pair.
  /// Requires: `words` words each.
  /// Fails with: the device's errors, Cancelled.
  /// Cost: O(columns^2 x words), and 8 bytes a pair.
  Result<void> count(Device& device, std::span<const Word> a, std::span<const Word> b,
                     const RunContext& run);

  /// Of the last count. Requires: it succeeded.
  CommonCounts of(std::size_t first, std::size_t second) const {
    return counts_[first * columns_.size() + second];
  }

  /// Estimate for `Compute::run`: measured on one core (docs/performance.md).
  double seconds() const {
    const auto columns = static_cast<double>(columns_.size());
    return 7e-11 * columns * columns * static_cast<double>(words_);
  }

 private:
  DeviceBuffer<Word> upload_columns(DeviceJob& job, bool is_transposed) const;

  std::vector<const Word*> columns_;
  std::size_t words_;
  DeviceBuffer<Word> resident_;
  std::vector<CommonCounts> counts_;
};

}  // namespace hewn
