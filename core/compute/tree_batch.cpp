#include "core/compute/tree_batch.h"

#include <algorithm>

#include "core/base/assert.h"
#include "core/compute/kernels/kernels.h"

namespace hewn {
namespace {

/// Steps times words between two looks at the cancel token: some 20 ms of one core, or of a GPU.
constexpr std::size_t kWorkPerLaunch = std::size_t{1} << 26;
constexpr std::size_t kWorkPerAcceleratedLaunch = std::size_t{1} << 33;

constexpr TreeOperand array_operand(int array) { return static_cast<TreeOperand>(-1 - array); }

TreeOp op_of(Token token) {
  switch (token) {
    case kUnionToken:
      return TreeOp::Union;
    case kIntersectionToken:
      return TreeOp::Intersection;
    case kDifferenceToken:
      return TreeOp::Difference;
    default:
      return TreeOp::Complement;
  }
}

}  // namespace

void TreeBatch::clear() {
  trees_.clear();
  steps_.clear();
  overlap_words_ = 0;
}

void TreeBatch::add(std::span<const Token> tree) {
  nodes_.clear();
  stack_.clear();
  for (std::size_t i = 0; i < tree.size(); ++i) {
    Node node;
    if (tree[i] < 0) {
      HEWN_ASSERT(stack_.size() >= (tree[i] == kComplementToken ? 1u : 2u), "operands are missing");
      node.right = stack_.back();
      stack_.pop_back();
      int least = nodes_[static_cast<std::size_t>(node.right)].arrays;
      int most = least;
      if (tree[i] != kComplementToken) {
        node.left = stack_.back();
        stack_.pop_back();
        least = std::min(least, nodes_[static_cast<std::size_t>(node.left)].arrays);
        most = std::max(most, nodes_[static_cast<std::size_t>(node.left)].arrays);
        // The needier operand comes first; its result then occupies one array (Sethi, Ullman 1970).
        if (least == most && least > 0) ++most;
      }
      node.arrays = std::max(most, 1);
    }
    nodes_.push_back(node);
    stack_.push_back(static_cast<std::int32_t>(i));
  }
  HEWN_ASSERT(stack_.size() == 1, "not one complete formula");
  HEWN_ASSERT(nodes_.back().arrays <= TreeKernel::kWorkArrays, "a tree of more than 2^15 leaves");
  TreeSpan span;
  span.first_step = static_cast<std::int64_t>(steps_.size());
  span.first_overlap = static_cast<std::int64_t>(overlap_words_);
  span.value = emit(tree, stack_.back(), 0);
  if (span.value < 0) span.value = kPreviousResult;
  span.steps =
      static_cast<std::int32_t>(static_cast<std::int64_t>(steps_.size()) - span.first_step);
  overlap_words_ += (static_cast<std::size_t>(span.steps) + 63) / 64;
  trees_.push_back(span);
}

TreeOperand TreeBatch::emit(std::span<const Token> tree, std::int32_t node, int first_array) {
  const Token token = tree[static_cast<std::size_t>(node)];
  if (token >= 0) return token;
  const Node& n = nodes_[static_cast<std::size_t>(node)];
  TreeStep step;
  step.op = op_of(token);
  step.target = static_cast<std::uint8_t>(first_array);
  if (token == kComplementToken) {
    step.b = emit(tree, n.right, first_array);
    if (step.b < 0) step.b = kPreviousResult;
  } else {
    const bool left_first = nodes_[static_cast<std::size_t>(n.left)].arrays >=
                            nodes_[static_cast<std::size_t>(n.right)].arrays;
    TreeOperand& early = left_first ? step.a : step.b;
    TreeOperand& late = left_first ? step.b : step.a;
    early = emit(tree, left_first ? n.left : n.right, first_array);
    const std::size_t early_end = steps_.size();
    late = emit(tree, left_first ? n.right : n.left, first_array + (early < 0 ? 1 : 0));
    if (late < 0) {
      if (early < 0) steps_[early_end - 1].is_kept = 1;
      late = kPreviousResult;
    } else if (early < 0) {
      early = kPreviousResult;
    }
  }
  steps_.push_back(step);
  return array_operand(first_array);
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
  std::fill(out.begin(), out.end(), TreeMeasures{});
  if (rows_ == 0 || batch.size() == 0) return {};
  std::vector<TreeCounts> counts(batch.size());
  std::vector<Word> overlaps(batch.overlap_words(), 0);
  const std::size_t step = words_per_part(device);
  for (std::size_t begin = 0; begin < words_; begin += step) {
    DeviceJob job(device);
    Part part{begin, std::min(step, words_ - begin), nullptr};
    const bool is_resident = part.words == words_ && resident_.device() == &device;
    if (!is_resident) resident_ = upload_part(job, begin, part.words);
    if (job.has_failed()) return job.result();
    part.bits = resident_.data();
    Result<void> done = measure_part(device, batch, part, counts, overlaps, run);
    if (part.words != words_) resident_ = {};
    if (!done) return done;
  }
  for (std::size_t t = 0; t < batch.size(); ++t) {
    const TreeSpan& tree = batch.trees()[t];
    out[t].held = counts[t].held;
    out[t].held_wanted = counts[t].held_wanted;
    for (std::int32_t w = 0; w < (tree.steps + 63) / 64; ++w) {
      out[t].overlaps += count_bits(overlaps[static_cast<std::size_t>(tree.first_overlap + w)]);
    }
  }
  return {};
}

Result<void> MeasuredRows::measure_part(Device& device, const TreeBatch& batch, const Part& part,
                                        std::span<TreeCounts> counts, std::span<Word> overlaps,
                                        const RunContext& run) const {
  const std::size_t most_work =
      device.info().is_accelerator ? kWorkPerAcceleratedLaunch : kWorkPerLaunch;
  DeviceJob job(device);
  const auto steps = job.upload(batch.steps());
  std::vector<TreeCounts> launch_counts;
  std::vector<Word> launch_overlaps;
  for (std::size_t first = 0; first < batch.size();) {
    if (run.is_cancelled()) return RunContext::cancelled();
    const TreeSpan& begin = batch.trees()[first];
    std::size_t last = first;
    std::size_t work = 0;
    for (; last < batch.size() && work < most_work; ++last) {
      work += static_cast<std::size_t>(batch.trees()[last].steps + 1) * part.words;
    }
    const auto first_overlap = static_cast<std::size_t>(begin.first_overlap);
    const std::size_t end_overlap =
        last < batch.size() ? static_cast<std::size_t>(batch.trees()[last].first_overlap)
                            : overlaps.size();
    const auto trees = job.upload(batch.trees().subspan(first, last - first));
    const auto out = job.allocate_filled<TreeCounts>(last - first, 0);
    const auto common = job.allocate_filled<Word>(end_overlap - first_overlap, 0);
    const Word* wanted = part.bits + columns_ * part.words;
    job.launch(TreeKernel{trees.data(), static_cast<std::int64_t>(trees.size()), steps.data(),
                          part.bits, static_cast<std::int64_t>(part.words), wanted,
                          wanted + part.words, out.data(), common.data(), begin.first_overlap});
    launch_counts.resize(last - first);
    launch_overlaps.resize(end_overlap - first_overlap);
    job.download(out, std::span<TreeCounts>(launch_counts));
    job.download(common, std::span<Word>(launch_overlaps));
    if (job.has_failed()) return job.result();
    for (std::size_t t = first; t < last; ++t) {
      counts[t].held += launch_counts[t - first].held;
      counts[t].held_wanted += launch_counts[t - first].held_wanted;
    }
    for (std::size_t w = 0; w < launch_overlaps.size(); ++w) {
      overlaps[first_overlap + w] |= launch_overlaps[w];
    }
    first = last;
  }
  return job.result();
}

}  // namespace hewn
