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
  std::fill(out.begin(), out.end(), std::uint64_t{0});
  if (samples_ == 0 || batch.size() == 0) return {};
  const std::size_t step = samples_per_part(device);
  for (std::size_t begin = 0; begin < padded_; begin += step) {
    const std::size_t samples = std::min(step, padded_ - begin);
    const bool is_resident = samples == padded_ && resident_.distances.device() == &device;
    DeviceJob job(device);
    if (!is_resident) resident_ = upload_part(job, begin, samples);
    Result<void> done = job.result();
    if (done) done = measure_part(device, batch, resident_, out, run);
    if (!done || samples != padded_) resident_ = {};
    if (!done) return done;
  }
  return {};
}

Result<void> SurfaceScores::measure_part(Device& device, const TreeBatch& batch, const Part& part,
                                         std::span<std::uint64_t> out,
                                         const RunContext& run) const {
  const std::size_t most_work =
      device.info().is_accelerator ? kWorkPerAcceleratedLaunch : kWorkPerLaunch;
  DeviceJob job(device);
  const auto steps = job.upload(batch.steps());
  std::vector<std::uint64_t> launch_totals;
  for (std::size_t first = 0; first < batch.size() && !job.has_failed();) {
    if (run.is_cancelled()) return RunContext::cancelled();
    std::size_t last = first;
    for (std::size_t work = 0; last < batch.size() && work < most_work; ++last) {
      work += static_cast<std::size_t>(batch.trees()[last].steps + 1) * part.samples;
    }
    const auto trees = job.upload(batch.trees().subspan(first, last - first));
    const auto totals = job.allocate_filled<std::uint64_t>(last - first, 0);
    job.launch(SurfaceScoreKernel{trees.data(), static_cast<std::int64_t>(last - first),
                                  steps.data(), static_cast<std::int64_t>(part.samples),
                                  part.distances.data(), part.scores.data(), totals.data()});
    launch_totals.assign(last - first, 0);
    job.download(totals, std::span<std::uint64_t>(launch_totals));
    for (std::size_t t = first; t < last; ++t) out[t] += launch_totals[t - first];
    first = last;
  }
  return job.result();
}

}  // namespace hewn
