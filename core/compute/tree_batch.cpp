#include "core/compute/tree_batch.h"

#include <algorithm>
#include <ranges>

#include "core/base/assert.h"
#include "core/compute/kernels/kernels.h"
#include "core/compute/parallel.h"

namespace hewn {
namespace {

/// Steps times words between two looks at the cancel token: some 20 ms of one core, or of a GPU.
constexpr std::size_t kWorkPerLaunch = std::size_t{1} << 26;
constexpr std::size_t kWorkPerAcceleratedLaunch = std::size_t{1} << 33;

constexpr std::int32_t overlap_words_of(const TreeSpan& tree) {
  return (tree.steps + kStepsPerOverlapWord - 1) / kStepsPerOverlapWord;
}

[[maybe_unused]] bool is_one_formula(std::span<const Token> tree) {
  std::int32_t open = 0;
  for (const Token token : tree) {
    const std::int32_t operands = token >= 0 ? 0 : token == kComplementToken ? 1 : 2;
    if (open < operands) return false;
    open += 1 - operands;
  }
  return open == 1;
}

/// Trees whose counts a thread puts together at a time.
constexpr std::size_t kTreesPerChunk = 16384;

/// One past the last tree of a launch that begins with `first`: the first one with which there are
/// so many steps, a tree's own value being one.
std::size_t end_of_launch(const TreeBatch& batch, std::size_t first, std::size_t most_steps) {
  const auto steps_before = [&](std::size_t tree) {
    const std::size_t steps = tree < batch.size()
                                  ? static_cast<std::size_t>(batch.trees()[tree].first_step)
                                  : batch.steps().size();
    return steps + tree;
  };
  const auto ends = std::views::iota(first + 1, batch.size());
  const auto end = std::ranges::partition_point(ends, [&](std::size_t tree) {
    return steps_before(tree) - steps_before(first) < most_steps;
  });
  return first + 1 + static_cast<std::size_t>(end - ends.begin());
}

}  // namespace

void TreeBatch::clear() {
  trees_.clear();
  steps_.clear();
  overlap_words_ = 0;
}

void TreeBatch::add(std::span<const Token> tree) {
  const auto size = static_cast<std::int32_t>(tree.size());
  nodes_.resize(tree.size());
  pending_.resize(tree.size() + 1);
  TreeSpan span;
  span.first_step = static_cast<std::int32_t>(steps_.size());
  span.first_overlap = static_cast<std::int32_t>(overlap_words_);
  span.steps = step_count(tree.data(), size);
  HEWN_ASSERT(steps_.size() + tree.size() < std::size_t{1} << 31, "too many steps in a batch");
  HEWN_ASSERT(is_one_formula(tree), "not one complete formula");
  steps_.resize(steps_.size() + static_cast<std::size_t>(span.steps));
  TreeStep* const steps = steps_.data() + span.first_step;
  span.value = write_steps(tree.data(), size, nodes_.data(), pending_.data(), steps);
  HEWN_ASSERT(nodes_.back().arrays <= TreeKernel::kWorkArrays, "a tree of more than 2^15 leaves");
  overlap_words_ += static_cast<std::size_t>(overlap_words_of(span));
  trees_.push_back(span);
}

MeasuredRows::MeasuredRows(std::size_t rows, const std::vector<std::vector<Word>>& columns,
                           const std::vector<Word>& wanted)
    : rows_(rows), words_(padded_words(rows)), columns_(columns.size()) {
  bits_.reserve((columns_ + 2) * words_);
  for (const std::vector<Word>& column : columns) {
    bits_.insert(bits_.end(), column.begin(), column.end());
  }
  bits_.insert(bits_.end(), wanted.begin(), wanted.end());
  bits_.resize((columns_ + 2) * words_, 0);
  Word* all = bits_.data() + (columns_ + 1) * words_;
  for (std::size_t i = 0; i < rows; ++i) set_bit(all, i);
}

std::size_t MeasuredRows::words_per_part(const Device& device) const {
  // The other half is for trees.
  const std::size_t fit = device.info().memory_budget / 2 / ((columns_ + 2) * sizeof(Word));
  return std::min(words_, std::max(fit / kWordBlock * kWordBlock, kWordBlock));
}

DeviceBuffer<Word> MeasuredRows::upload_part(DeviceJob& job, std::size_t begin,
                                             std::size_t words) const {
  if (words == words_) return job.upload(std::span<const Word>(bits_));
  std::vector<Word> part;
  part.reserve((columns_ + 2) * words);
  for (std::size_t k = 0; k < columns_ + 2; ++k) {
    const Word* from = bits_.data() + k * words_ + begin;
    part.insert(part.end(), from, from + words);
  }
  return job.upload(std::span<const Word>(part));
}

Result<void> MeasuredRows::measure(Device& device, const TreeBatch& batch,
                                   std::span<TreeMeasures> out, const RunContext& run) {
  if (rows_ == 0 || batch.size() == 0) {
    std::fill(out.begin(), out.end(), TreeMeasures{});
    return {};
  }
  // What they hold is downloaded.
  counts_.resize(batch.size());
  overlaps_.resize(batch.overlap_words());
  const std::size_t step = words_per_part(device);
  for (std::size_t begin = 0; begin < words_; begin += step) {
    DeviceJob job(device);
    Part part{begin, std::min(step, words_ - begin), nullptr};
    const bool is_resident = part.words == words_ && resident_.device() == &device;
    if (!is_resident) resident_ = upload_part(job, begin, part.words);
    if (job.has_failed()) return job.result();
    part.bits = resident_.data();
    Result<void> done = measure_part(device, batch, part, run);
    if (part.words != words_) resident_ = {};
    if (!done) return done;
  }
  for_each_chunk(run.threads, batch.size(), kTreesPerChunk,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t t = begin; t < end; ++t)
                     out[t] = measures_of(batch.trees()[t], counts_[t]);
                 });
  return {};
}

TreeMeasures MeasuredRows::measures_of(const TreeSpan& tree, const TreeCounts& counts) const {
  TreeMeasures m{counts.held, counts.held_wanted, 0};
  for (std::int32_t w = 0; w < overlap_words_of(tree); ++w) {
    m.overlaps += count_bits(overlaps_[static_cast<std::size_t>(tree.first_overlap + w)]);
  }
  return m;
}

Result<void> MeasuredRows::measure_part(Device& device, const TreeBatch& batch, const Part& part,
                                        const RunContext& run) {
  const std::size_t most_work =
      device.info().is_accelerator ? kWorkPerAcceleratedLaunch : kWorkPerLaunch;
  DeviceJob job(device);
  const auto steps = job.upload(batch.steps());
  for (std::size_t first = 0; first < batch.size() && !job.has_failed();) {
    if (run.is_cancelled()) return RunContext::cancelled();
    const std::size_t last = end_of_launch(batch, first, most_work / part.words);
    const std::int32_t first_overlap = batch.trees()[first].first_overlap;
    const std::size_t end_overlap =
        last < batch.size() ? static_cast<std::size_t>(batch.trees()[last].first_overlap)
                            : overlaps_.size();
    const auto launch_counts = std::span(counts_).subspan(first, last - first);
    const auto launch_overlaps =
        std::span(overlaps_).subspan(static_cast<std::size_t>(first_overlap),
                                     end_overlap - static_cast<std::size_t>(first_overlap));
    const auto trees = job.upload(batch.trees().subspan(first, last - first));
    // What the parts before have found comes along.
    const bool is_first = part.begin == 0;
    const auto out = is_first ? job.allocate_filled<TreeCounts>(launch_counts.size(), 0)
                              : job.upload(std::span<const TreeCounts>(launch_counts));
    const auto common = is_first ? job.allocate_filled<OverlapWord>(launch_overlaps.size(), 0)
                                 : job.upload(std::span<const OverlapWord>(launch_overlaps));
    const Word* wanted = part.bits + columns_ * part.words;
    job.launch(TreeKernel{trees.data(), static_cast<std::int64_t>(trees.size()), steps.data(),
                          part.bits, static_cast<std::int64_t>(part.words), wanted,
                          wanted + part.words, out.data(), common.data(), first_overlap});
    job.download(out, launch_counts);
    job.download(common, launch_overlaps);
    first = last;
  }
  return job.result();
}

}  // namespace hewn
