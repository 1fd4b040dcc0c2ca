#include "core/compute/surface_scores.h"

#include <algorithm>
#include <type_traits>

#include "core/compute/kernels/kernels.h"

namespace hewn {
namespace {

/// Steps times samples between two looks at the cancel token: some 20 ms of one core, or of a GPU.
constexpr std::size_t kWorkPerLaunch = std::size_t{1} << 24;
constexpr std::size_t kWorkPerAcceleratedLaunch = std::size_t{1} << 32;

std::size_t padded(std::size_t samples) {
  constexpr auto kBlock = static_cast<std::size_t>(SurfaceScoreKernel::kSampleBlock);
  return (samples + kBlock - 1) / kBlock * kBlock;
}

}  // namespace

SurfaceScores::SurfaceScores(std::size_t primitives, std::size_t samples)
    : primitives_(primitives),
      samples_(samples),
      padded_(padded(samples)),
      distances_(primitives_ * padded_, 0.0f),
      scores_(2 * primitives_ * padded_, 0u) {}

void SurfaceScores::set(std::size_t primitive, std::size_t sample, const SampleScore& score) {
  distances_[primitive * padded_ + sample] = score.distance;
  scores_[2 * primitive * padded_ + sample] = score.score;
  scores_[(2 * primitive + 1) * padded_ + sample] = score.turned_score;
}

std::size_t SurfaceScores::samples_per_part(const Device& device) const {
  constexpr auto kBlock = static_cast<std::size_t>(SurfaceScoreKernel::kSampleBlock);
  const std::size_t bytes = primitives_ * (sizeof(float) + 2 * sizeof(std::uint32_t));
  // The other half is for trees.
  const std::size_t fit = device.info().memory_budget / 2 / std::max<std::size_t>(bytes, 1);
  return std::min(padded_, std::max(fit / kBlock * kBlock, kBlock));
}

SurfaceScores::Part SurfaceScores::upload_part(DeviceJob& job, std::size_t begin,
                                               std::size_t samples) const {
  const auto upload = [&](const auto& rows) {
    using T = typename std::decay_t<decltype(rows)>::value_type;
    if (samples == padded_) return job.upload(std::span<const T>(rows));
    std::vector<T> part;
    part.reserve(rows.size() / padded_ * samples);
    for (std::size_t row = begin; row < rows.size(); row += padded_) {
      part.insert(part.end(), rows.data() + row, rows.data() + row + samples);
    }
    return job.upload(std::span<const T>(part));
  };
  return {samples, upload(distances_), upload(scores_)};
}

Result<void> SurfaceScores::measure(Device& device, const TreeBatch& batch,
                                    std::span<std::uint64_t> out, const RunContext& run) {
  if (batch.size() == 0) return {};
  DeviceJob job(device);
  const auto steps = job.upload(batch.steps());
  const auto spans = job.upload(batch.trees());
  const auto totals = job.allocate_filled<std::uint64_t>(batch.size(), 0);
  if (job.has_failed()) return job.result();
  const std::size_t steps_each = batch.steps().size() / batch.size();
  Result<void> added =
      add_to(device, {spans.data(), batch.size(), steps.data(), steps_each, totals.data()}, run);
  if (!added) return added;
  job.download(totals, out);
  return job.result();
}

Result<void> SurfaceScores::add_to(Device& device, const ScoredTrees& trees,
                                   const RunContext& run) {
  if (samples_ == 0 || trees.count == 0) return {};
  const std::size_t step = samples_per_part(device);
  for (std::size_t begin = 0; begin < padded_; begin += step) {
    const std::size_t samples = std::min(step, padded_ - begin);
    const bool is_resident = samples == padded_ && resident_.distances.device() == &device;
    DeviceJob job(device);
    if (!is_resident) resident_ = upload_part(job, begin, samples);
    Result<void> done = job.result();
    if (done) done = add_part(device, resident_, trees, run);
    if (!done || samples != padded_) resident_ = {};
    if (!done) return done;
  }
  return {};
}

Result<void> SurfaceScores::add_part(Device& device, const Part& part, const ScoredTrees& trees,
                                     const RunContext& run) const {
  const std::size_t most_work =
      device.info().is_accelerator ? kWorkPerAcceleratedLaunch : kWorkPerLaunch;
  const std::size_t work_each = (trees.steps_each + 1) * part.samples;
  const std::size_t most_trees = std::max<std::size_t>(1, most_work / work_each);
  DeviceJob job(device);
  for (std::size_t first = 0; first < trees.count && !job.has_failed(); first += most_trees) {
    if (run.is_cancelled()) return RunContext::cancelled();
    // A look at a total waits for the launch before.
    std::uint64_t total = 0;
    if (first > 0) job.download(trees.totals, std::span(&total, 1));
    const std::size_t count = std::min(most_trees, trees.count - first);
    job.launch(SurfaceScoreKernel{trees.spans + first, static_cast<std::int64_t>(count),
                                  trees.steps, static_cast<std::int64_t>(part.samples),
                                  part.distances.data(), part.scores.data(), trees.totals + first});
  }
  return job.result();
}

}  // namespace hewn
