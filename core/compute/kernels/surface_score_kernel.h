#pragma once
/// Many trees over solids at once: how well does each fit a sampled surface?
#include "core/compute/kernels/tree_kernel.h"

namespace hewn {

/// The total score of each tree's surface (Fayolle and Pasko 2016). At every sample the tree's
/// distance and normal are those of one of its primitives, perhaps turned inside out; bottom-up it
/// becomes known which, and that primitive's score, computed beforehand, is the tree's. Scores are
/// integers, so that sums come out the same in any order.
///
/// One item is one tree at `kSamples` samples. Cost: trees x steps x samples.
struct SurfaceScoreKernel {
  const TreeSpan* trees = nullptr;
  std::int64_t tree_count = 0;
  const TreeStep* steps = nullptr;  ///< operands are primitives instead of columns
  /// Fewer than 2^29 and a multiple of `kSampleBlock`; the padding scores 0.
  std::int64_t samples = 0;
  const float* distances = nullptr;       ///< by primitive, then by sample
  const std::uint32_t* scores = nullptr;  ///< as it is and turned, by primitive, then by sample
  std::uint64_t* totals = nullptr;        ///< out, one a tree; 0 at first

  static constexpr std::int64_t kSampleBlock = 64;
  static constexpr std::uint32_t kLargestScore = (std::uint32_t{1} << 24) - 1;

  template <class Grain>
  HEWN_HD std::int64_t items() const {
    constexpr std::int64_t kGroupSamples = Grain::kSamples * Grain::kGroup;
    return (samples + kGroupSamples - 1) / kGroupSamples * Grain::kGroup * tree_count;
  }

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const std::int64_t group = quotient(item / Grain::kGroup, tree_count);
    const std::int64_t index = item / Grain::kGroup - group * tree_count;
    const std::int64_t row = (group * Grain::kGroup + item % Grain::kGroup) * Grain::kSamples;
    if (row >= samples) return;
    const TreeSpan& tree = trees[index];
    Sides<Grain::kSamples> work[TreeKernel::kWorkArrays];
    Sides<Grain::kSamples> last, b;
    for (std::int32_t i = 0; i < tree.steps; ++i) {
      const TreeStep step = load<TreeStep>(steps + tree.first_step + i);
      if (step.a != kPreviousResult) fetch(step.a, row, work, last);
      if (step.op == TreeOp::Complement) {
        last.turn();
      } else {
        fetch(step.b, row, work, b);
        if (step.op == TreeOp::Difference) b.turn();
        if (step.op == TreeOp::ReverseDifference) last.turn();
        last.take(b, step.op == TreeOp::Union, step.is_swapped != 0);
      }
      if (step.is_kept != 0) work[step.target] = last;
    }
    if (tree.value != kPreviousResult) fetch(tree.value, row, work, last);
    // What a group adds up in one step.
    static_assert(std::uint64_t{Grain::kSamples} * Grain::kGroup * kLargestScore <= 0xffffffffu);
    std::uint32_t total = 0;
    for (int r = 0; r < Grain::kSamples; ++r) total += scores[last.source[r] * samples + row + r];
    sum_into(totals + index, total);
  }

 private:
  /// Distances at some samples, and what decides there: twice the primitive's number, plus one
  /// where it is turned inside out.
  template <int kRows>
  struct Sides {
    float distance[kRows];
    std::int16_t source[kRows];

    HEWN_HD void turn() {
      for (int r = 0; r < kRows; ++r) {
        distance[r] = -distance[r];
        source[r] = static_cast<std::int16_t>(source[r] ^ 1);
      }
    }
    /// Keeps the lower of two distances or the higher one; of equal ones the other's if it is
    /// `preferred`. Branches that a warp takes together cost less than choices in each row.
    HEWN_HD void take(const Sides& o, bool lower, bool preferred) {
      if (lower && preferred) {
        take_where(o, [](float own, float other) { return other <= own; });
      } else if (lower) {
        take_where(o, [](float own, float other) { return other < own; });
      } else if (preferred) {
        take_where(o, [](float own, float other) { return other >= own; });
      } else {
        take_where(o, [](float own, float other) { return other > own; });
      }
    }
    template <class IsBetter>
    HEWN_HD void take_where(const Sides& o, const IsBetter& is_better) {
      for (int r = 0; r < kRows; ++r) {
        const bool is_taken = is_better(distance[r], o.distance[r]);
        source[r] = is_taken ? o.source[r] : source[r];
        distance[r] = is_taken ? o.distance[r] : distance[r];
      }
    }
  };

  template <int kRows>
  HEWN_HD void fetch(TreeOperand operand, std::int64_t row, const Sides<kRows>* work,
                     Sides<kRows>& to) const {
    if (operand < 0) {
      to = work[-1 - operand];
    } else {
      const auto stride = static_cast<std::int32_t>(samples * sizeof(float));
      const float* own = offset_by(distances, operand, stride);
      // Devices move 16 bytes at a time when they know that they may.
      const auto* from = static_cast<const float*>(__builtin_assume_aligned(own + row, 16));
      for (int r = 0; r < kRows; ++r) {
        to.distance[r] = from[r];
        to.source[r] = static_cast<std::int16_t>(2 * operand);
      }
    }
  }
};

}  // namespace hewn
