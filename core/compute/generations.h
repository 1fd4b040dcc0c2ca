#pragma once
/// A genetic search's trees, which live, breed and are scored on a device.
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/compute/device.h"
#include "core/compute/kernels/generation_kernels.h"
#include "core/compute/surface_scores.h"

namespace hewn {

/// One generation after the other. What leaves the device is the sizes and scores alone, and the
/// trees that are asked for. The same trees on every device. For one thread.
class Generations {
 public:
  static constexpr std::size_t kMostTokens = TreeRows::kMostTokens;

  /// `scores` and the device must outlive it. Requires: `rules.most_tokens` <= `kMostTokens`.
  Generations(Device& device, SurfaceScores& scores, const BreedingRules& rules,
              const TreeWorth& worth)
      : device_(device), scores_(scores), rules_(rules), worth_(worth) {}

  /// The first generation, which all later ones are as large as. Requires: trees of 1 to
  /// `kMostTokens` tokens. Fails with: the device's errors, Cancelled.
  Result<void> begin(std::span<const std::vector<Token>> trees, const RunContext& run);

  /// The next one: first the trees at the places in `elite`, then children; `seed` stands for all
  /// random numbers. Fails with: the device's errors, Cancelled; then the generation is undefined.
  /// Cost: as `SurfaceScores::measure` for the children; three launches.
  Result<void> breed(std::span<const std::int32_t> elite, std::uint64_t seed,
                     const RunContext& run);

  std::size_t size() const { return sizes_.size(); }
  /// Of the tree's surface, the share of the best score that there could be.
  double fit(std::size_t tree) const { return worth_.fit(totals_[tree]); }
  double score(std::size_t tree) const { return worth_.score(totals_[tree], sizes_[tree]); }
  Result<std::vector<Token>> tree(std::size_t tree) const;

 private:
  /// A generation in the device's memory.
  struct Rows {
    DeviceBuffer<Token> tokens;
    DeviceBuffer<std::int32_t> sizes;
    DeviceBuffer<std::uint64_t> totals;
    TreeRows view() const { return {tokens.data(), sizes.data(), totals.data()}; }
  };
  Result<void> check_room(std::size_t trees) const;
  Result<void> score_from(std::size_t first, const RunContext& run);

  Device& device_;
  SurfaceScores& scores_;
  BreedingRules rules_;
  TreeWorth worth_;
  Rows own_, next_;
  DeviceBuffer<TreeSpan> spans_;
  DeviceBuffer<TreeStep> steps_;
  std::vector<std::int32_t> sizes_;
  std::vector<std::uint64_t> totals_;
};

}  // namespace hewn
