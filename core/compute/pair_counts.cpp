#include "core/compute/pair_counts.h"

#include "core/compute/kernels/kernels.h"

namespace hewn {

DeviceBuffer<Word> PairCounts::upload_columns(DeviceJob& job, bool is_transposed) const {
  std::vector<Word> together(columns_.size() * words_);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    for (std::size_t w = 0; w < words_; ++w) {
      together[is_transposed ? w * columns_.size() + k : k * words_ + w] = columns_[k][w];
    }
  }
  return job.upload(std::span<const Word>(together));
}

Result<void> PairCounts::count(Device& device, std::span<const Word> a, std::span<const Word> b,
                               const RunContext& run) {
  if (run.is_cancelled()) return RunContext::cancelled();
  // Neighbouring items of an accelerator read neighbouring words.
  const bool is_transposed = device.info().is_accelerator;
  DeviceJob job(device);
  if (resident_.device() != &device) resident_ = upload_columns(job, is_transposed);
  const auto first = job.upload(a);
  const auto second = job.upload(b);
  const auto counts = job.allocate<CommonCounts>(columns_.size() * columns_.size());
  job.launch(PairCountKernel{first.data(), second.data(), resident_.data(),
                             static_cast<std::int64_t>(columns_.size()),
                             static_cast<std::int64_t>(words_), is_transposed, counts.data()});
  counts_.resize(counts.size());
  job.download(counts, std::span(counts_));
  if (job.has_failed()) resident_ = {};
  return job.result();
}

}  // namespace hewn
