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

constexpr TreeOperand array_operand(int array) { return static_cast<TreeOperand>(-1 - array); }
/// Results that are not columns are those of the step before when they are asked for at once.
constexpr TreeOperand at_hand(TreeOperand operand) {
  return operand < 0 ? kPreviousResult : operand;
}
/// What complements have in the place of their second operand.
constexpr TreeOperand kAllRows = array_operand(0);

constexpr std::int32_t overlap_words_of(const TreeSpan& tree) {
  return (tree.steps + kStepsPerOverlapWord - 1) / kStepsPerOverlapWord;
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
  HEWN_ASSERT(steps_.size() + tree.size() < std::size_t{1} << 31, "too many steps in a batch");
  span.first_step = static_cast<std::int32_t>(steps_.size());
  span.first_overlap = static_cast<std::int32_t>(overlap_words_);
  span.value = at_hand(emit(tree, stack_.back(), 0));
  span.steps = static_cast<std::int32_t>(steps_.size()) - span.first_step;
  overlap_words_ += static_cast<std::size_t>(overlap_words_of(span));
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
    step.a = at_hand(emit(tree, n.right, first_array));
    step.b = kAllRows;
  } else {
    emit_operands(tree, n, first_array, step);
  }
  steps_.push_back(step);
  return array_operand(first_array);
}

void TreeBatch::emit_operands(std::span<const Token> tree, const Node& node, int first_array,
                              TreeStep& step) {
  // The needier operand comes first; its result then occupies one array (Sethi, Ullman 1970).
  const bool left_first = nodes_[static_cast<std::size_t>(node.left)].arrays >=
                          nodes_[static_cast<std::size_t>(node.right)].arrays;
  const TreeOperand early = emit(tree, left_first ? node.left : node.right, first_array);
  const std::size_t early_end = steps_.size();
  const TreeOperand late =
      emit(tree, left_first ? node.right : node.left, first_array + (early < 0 ? 1 : 0));
  // What was found last is at hand. Two columns stay in the tree's order.
  const bool late_is_at_hand = late < 0;
  step.a = at_hand(late_is_at_hand ? late : early);
  step.b = late_is_at_hand ? early : late;
  if (late_is_at_hand && early < 0) steps_[early_end - 1].is_kept = 1;
  step.is_swapped = late_is_at_hand == left_first ? 1 : 0;
  if (step.op == TreeOp::Difference && step.is_swapped != 0) step.op = TreeOp::ReverseDifference;
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
