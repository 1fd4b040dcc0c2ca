#include "core/compute/surface_scores.h"

#include <algorithm>

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

Result<void> SurfaceScores::measure(Device& device, const TreeBatch& batch,
                                    std::span<std::uint64_t> out, const RunContext& run) {
  std::fill(out.begin(), out.end(), std::uint64_t{0});
  if (samples_ == 0 || batch.size() == 0) return {};
  const std::size_t most_work =
      device.info().is_accelerator ? kWorkPerAcceleratedLaunch : kWorkPerLaunch;
  DeviceJob job(device);
  if (resident_scores_.device() != &device) {
    resident_distances_ = job.upload(std::span<const float>(distances_));
    resident_scores_ = job.upload(std::span<const std::uint32_t>(scores_));
  }
  const auto steps = job.upload(batch.steps());
  for (std::size_t first = 0; first < batch.size() && !job.has_failed();) {
    if (run.is_cancelled()) return RunContext::cancelled();
    std::size_t last = first;
    for (std::size_t work = 0; last < batch.size() && work < most_work; ++last) {
      work += static_cast<std::size_t>(batch.trees()[last].steps + 1) * padded_;
    }
    const auto trees = job.upload(batch.trees().subspan(first, last - first));
    const auto totals = job.allocate_filled<std::uint64_t>(last - first, 0);
    job.launch(SurfaceScoreKernel{trees.data(), static_cast<std::int64_t>(last - first),
                                  steps.data(), static_cast<std::int64_t>(padded_),
                                  resident_distances_.data(), resident_scores_.data(),
                                  totals.data()});
    job.download(totals, out.subspan(first, last - first));
    first = last;
  }
  return job.result();
}

}  // namespace hewn
