#pragma once
/// How good creatures are: geometry, size and proximity in one pass over bit columns, a whole
/// generation at a time, on the device that suits.
#include <memory>
#include <span>

#include "core/compute/compute.h"
#include "core/synth/evolve/genome.h"

namespace hewn {

/// What is measured of a tree.
struct Measures {
  int inside_right = 0;   ///< rows to hold that it holds
  int outside_right = 0;  ///< rows to leave out that it leaves out
  int size = 0;           ///< nodes
  int proximity = 0;      ///< P(T); divided by the size it is the proximity
};

/// The rows on which creatures are judged; those that do not matter are left out. For one thread.
class FitnessTable {
 public:
  /// Rows are the cells of `care`; `wanted` tells which of them to hold. Measures on
  /// `compute_of(run)`.
  FitnessTable(const CellColumns& cells, const Column& wanted, const Column& care,
               const RunContext& run);

  int literals() const { return static_cast<int>(rows_.columns()); }
  int inside_rows() const { return inside_; }
  int outside_rows() const { return outside_; }

  /// One for each genome; the same numbers on every device. Fails with: Cancelled.
  /// Cost: O(nodes x words), shared by all workers.
  Result<std::vector<Measures>> measure(std::span<const Genome* const> genomes,
                                        const RunContext& run);

 private:
  std::shared_ptr<Compute> compute_;
  int inside_ = 0, outside_ = 0;
  MeasuredRows rows_;
  TreeBatch batch_;
  std::vector<TreeMeasures> measured_;
};

}  // namespace hewn
