#include "core/compute/generations.h"

#include <algorithm>
#include <utility>

#include "core/base/assert.h"
#include "core/compute/kernels/kernels.h"

namespace hewn {

Result<void> Generations::check_room(std::size_t trees) const {
  constexpr std::size_t kBytesOfTree =
      2 * (kMostTokens * sizeof(Token) + sizeof(std::int32_t) + sizeof(std::uint64_t)) +
      sizeof(TreeSpan) + kMostTokens * sizeof(TreeStep);
  const DeviceInfo& info = device_.info();
  // The other half is for scores.
  if (info.is_accelerator && trees * kBytesOfTree > info.memory_budget / 2) {
    return Error{ErrorCode::OutOfMemory, "too many trees for its memory", info.name};
  }
  return {};
}

Result<void> Generations::begin(std::span<const std::vector<Token>> trees, const RunContext& run) {
  const std::size_t count = trees.size();
  if (Result<void> done = check_room(count); !done) return done;
  sizes_.assign(count, 0);
  totals_.assign(count, 0);
  std::vector<Token> tokens(count * kMostTokens);
  for (std::size_t t = 0; t < count; ++t) {
    HEWN_ASSERT(!trees[t].empty() && trees[t].size() <= kMostTokens, "no room for a tree");
    std::copy(trees[t].begin(), trees[t].end(),
              tokens.begin() + static_cast<std::ptrdiff_t>(t * kMostTokens));
    sizes_[t] = static_cast<std::int32_t>(trees[t].size());
  }
  DeviceJob job(device_);
  own_ = {job.upload(std::span<const Token>(tokens)),
          job.upload(std::span<const std::int32_t>(sizes_)),
          job.allocate_filled<std::uint64_t>(count, 0)};
  next_ = {job.allocate<Token>(count * kMostTokens), job.allocate<std::int32_t>(count),
           job.allocate<std::uint64_t>(count)};
  spans_ = job.allocate<TreeSpan>(count);
  steps_ = job.allocate<TreeStep>(count * kMostTokens);
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
