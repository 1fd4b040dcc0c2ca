#pragma once
/// Many candidate trees scored at once on samples of a surface.
#include <cstdint>
#include <span>
#include <vector>

#include "core/compute/kernels/surface_score_kernel.h"
#include "core/compute/tree_batch.h"

namespace hewn {

/// What one primitive has at one sample.
struct SampleScore {
  float distance = 0;  ///< signed
  /// For the primitive as it is and turned inside out, at most
  /// `SurfaceScoreKernel::kLargestScore`.
  std::uint32_t score = 0, turned_score = 0;
};

/// Trees in a device's memory, with the totals that their scores are added to.
struct ScoredTrees {
  const TreeSpan* spans = nullptr;
  std::size_t count = 0;
  const TreeStep* steps = nullptr;
  std::size_t steps_each = 0;  ///< about: bounds how long a launch takes
  std::uint64_t* totals = nullptr;
};

/// Distances and scores of primitives at samples. Kept on the device that scored last where they
/// fit into its budget, else sent in parts each time. One thread.
class SurfaceScores {
 public:
  /// Everything is 0. Requires: at most 2^14 primitives, fewer than 2^31 samples.
  SurfaceScores(std::size_t primitives, std::size_t samples);

  std::size_t primitives() const { return primitives_; }
  std::size_t samples() const { return samples_; }

  /// Before the first `measure`. Different primitives may be set at the same time.
  void set(std::size_t primitive, std::size_t sample, const SampleScore& score);

  /// The sum over all samples of the score of that primitive, turned or not, that decides the
  /// tree's distance there; the same on every device.
  /// Requires: `out.size() == batch.size()`; the trees' primitives exist.
  /// Fails with: the device's errors, Cancelled. Cost: O(steps x samples).
  Result<void> measure(Device& device, const TreeBatch& batch, std::span<std::uint64_t> out,
                       const RunContext& run);

  /// Adds the same sums to the trees' totals, on the device; kernels may still run afterwards.
  Result<void> add_to(Device& device, const ScoredTrees& trees, const RunContext& run);

  /// Estimate for `Compute::run`: measured on one core (docs/performance.md).
  double seconds_for(double steps) const { return 7e-10 * steps * static_cast<double>(padded_); }
  double seconds_for(const TreeBatch& batch) const {
    return seconds_for(static_cast<double>(batch.steps().size()));
  }

 private:
  /// Distances and scores at some samples in a row, in a device's memory.
  struct Part {
    std::size_t samples = 0;
    DeviceBuffer<float> distances;
    DeviceBuffer<std::uint32_t> scores;
  };
  std::size_t samples_per_part(const Device& device) const;
  Part upload_part(DeviceJob& job, std::size_t begin, std::size_t samples) const;
  Result<void> add_part(Device& device, const Part& part, const ScoredTrees& trees,
                        const RunContext& run) const;

  std::size_t primitives_, samples_, padded_;
  std::vector<float> distances_;       ///< by primitive, then by sample
  std::vector<std::uint32_t> scores_;  ///< as it is and turned, by primitive, then by sample
  Part resident_;                      ///< where all of it fits
};

}  // namespace hewn
