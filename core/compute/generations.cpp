#include "core/compute/generations.h"

#include <algorithm>
#include <utility>

#include "core/base/assert.h"
#include "core/compute/kernels/kernels.h"

namespace hewn {

Result<void> Generations::allocate(std::size_t trees) {
  constexpr std::size_t kBytesOfTree =
      2 * (kMostTokens * sizeof(Token) + sizeof(std::int32_t) + sizeof(std::uint64_t)) +
      sizeof(TreeSpan) + kMostTokens * sizeof(TreeStep);
  const DeviceInfo& info = device_.info();
  // The other half is for scores.
  if (info.is_accelerator && trees * kBytesOfTree > info.memory_budget / 2) {
    return Error{ErrorCode::OutOfMemory, "too many trees for its memory", info.name};
  }
  DeviceJob job(device_);
  for (Rows* rows : {&own_, &next_}) {
    rows->tokens = job.allocate<Token>(trees * kMostTokens);
    rows->sizes = job.allocate<std::int32_t>(trees);
    rows->totals = job.allocate_filled<std::uint64_t>(trees, 0);
  }
  spans_ = job.allocate<TreeSpan>(trees);
  steps_ = job.allocate<TreeStep>(trees * kMostTokens);
  return job.result();
}

Result<void> Generations::begin(std::span<const std::vector<Token>> trees, const RunContext& run) {
  sizes_.assign(trees.size(), 0);
  totals_.assign(trees.size(), 0);
  if (Result<void> done = allocate(trees.size()); !done) return done;
  std::vector<Token> tokens(trees.size() * kMostTokens);
  for (std::size_t t = 0; t < trees.size(); ++t) {
    HEWN_ASSERT(!trees[t].empty() && trees[t].size() <= kMostTokens, "no room for a tree");
    std::copy(trees[t].begin(), trees[t].end(),
              tokens.begin() + static_cast<std::ptrdiff_t>(t * kMostTokens));
    sizes_[t] = static_cast<std::int32_t>(trees[t].size());
  }
  DeviceJob job(device_);
  own_.tokens = job.upload(std::span<const Token>(tokens));
  own_.sizes = job.upload(std::span<const std::int32_t>(sizes_));
  if (job.has_failed()) return job.result();
  return score_from(0, run);
}

Result<void> Generations::breed(std::span<const std::int32_t> elite, std::uint64_t seed,
                                const RunContext& run) {
  DeviceJob job(device_);
  const auto chosen = job.upload(elite);
  job.launch(BreedKernel{own_.view(), next_.view(), static_cast<std::int64_t>(size()),
                         chosen.data(), static_cast<std::int64_t>(elite.size()), rules_, worth_,
                         seed});
  if (job.has_failed()) return job.result();
  std::swap(own_, next_);
  return score_from(elite.size(), run);
}

/// Those before `first` have their totals already.
Result<void> Generations::score_from(std::size_t first, const RunContext& run) {
  DeviceJob job(device_);
  job.launch(TranslateKernel{own_.view(), static_cast<std::int64_t>(size()), spans_.data(),
                             steps_.data()});
  if (job.has_failed()) return job.result();
  // Most operations take two operands.
  const auto steps_each = static_cast<std::size_t>(rules_.most_tokens) / 2;
  Result<void> added = scores_.add_to(device_,
                                      {spans_.data() + first, size() - first, steps_.data(),
                                       steps_each, own_.totals.data() + first},
                                      run);
  if (!added) return added;
  job.download(own_.sizes, std::span(sizes_));
  job.download(own_.totals, std::span(totals_));
  return job.result();
}

Result<std::vector<Token>> Generations::tree(std::size_t tree) const {
  std::vector<Token> tokens(static_cast<std::size_t>(sizes_[tree]));
  DeviceJob job(device_);
  job.download(own_.tokens.data() + tree * kMostTokens, std::span(tokens));
  if (job.has_failed()) return job.result().error();
  return tokens;
}

}  // namespace hewn
