#pragma once
/// Many trees at once on bit columns: how many rows each gets right, and which operands overlap.
#include <cstddef>

#include "core/compute/host_device.h"

namespace hewn {

/// In the low bits what `combine` needs.
enum class TreeOp : std::uint8_t {
  Intersection = 0,
  Union = 1,
  ReverseDifference = 2,  ///< the second operand without the first
  Difference = 3,
  Complement = 6  ///< all rows without the first operand
};

/// An operand at or above 0 is a column, `kPreviousResult` that of the step before; any other is
/// work array -1 - operand.
using TreeOperand = std::int16_t;
inline constexpr TreeOperand kPreviousResult = -32768;

/// One operation. The first operand stays at hand: it is the result of the step before or a column.
/// The second is a column or a work array; complements have none.
struct alignas(8) TreeStep {
  TreeOp op = TreeOp::Union;
  std::uint8_t target = 0;  ///< work array that keeps the result, if any does
  TreeOperand a = kPreviousResult;
  /// Whether a later step than the next reads the result: else it need not leave the registers.
  std::uint8_t is_kept = 0;
  /// Whether the tree has the operands the other way round: where that matters, the tree's first
  /// one is preferred.
  std::uint8_t is_swapped = 0;
  TreeOperand b = 0;
};

struct TreeSpan {
  std::int32_t first_step = 0;
  std::int32_t first_overlap = 0;  ///< place of the tree's first step in `overlaps`
  std::int32_t steps = 0;
  TreeOperand value = 0;  ///< where the tree's own value is after the last step
};

/// Bit i of a tree's words tells that the operands of its step i have a row in common. Complements
/// have no such bit.
using OverlapWord = std::uint32_t;
inline constexpr std::int32_t kStepsPerOverlapWord = 32;

struct TreeCounts {
  int held = 0;         ///< rows inside the tree
  int held_wanted = 0;  ///< of those, rows of the wanted solid
};

/// One item is one tree on `kWords` words of rows. Cost: trees x steps x words, reading every
/// operand once.
struct TreeKernel {
  /// A tree of n leaves needs no more than log2(n) + 1, and no operand can number more leaves.
  static constexpr int kWorkArrays = 16;

  const TreeSpan* trees = nullptr;
  std::int64_t tree_count = 0;
  const TreeStep* steps = nullptr;
  const Word* columns = nullptr;  ///< zero beyond the last row
  std::int64_t words = 0;         ///< per column, a multiple of `kWordBlock`
  const Word* wanted = nullptr;
  const Word* all = nullptr;        ///< every row
  TreeCounts* counts = nullptr;     ///< out, one a tree; 0 at first
  OverlapWord* overlaps = nullptr;  ///< out; 0 at first
  std::int32_t overlaps_begin = 0;  ///< the place that `overlaps` starts with

  /// Words of items that work in step. With more than `kMovedWords` an item, they divide `words`.
  template <class Grain>
  static constexpr std::int64_t kGroupWords = std::int64_t{Grain::kWords} * Grain::kGroup;

  /// Neighbouring items take one tree on neighbouring words, and then the next tree on the same
  /// words, which are then in the nearest cache.
  template <class Grain>
  HEWN_HD std::int64_t items() const {
    return (words + kGroupWords<Grain> - 1) / kGroupWords<Grain> * Grain::kGroup * tree_count;
  }

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const std::int64_t warp = item / Grain::kGroup;
    const std::int64_t group = warp < tree_count ? 0 : quotient(warp, tree_count);
    const std::int64_t index = warp - group * tree_count;
    if constexpr (Grain::kWords == Grain::kBlock) {
      // Pairs of words go around among the items of a group, which then read whole lines.
      const std::int64_t begin = group * kGroupWords<Grain> + item % Grain::kGroup * kMovedWords;
      if (begin < words) run_in_registers<Grain>(trees[index], begin, counts[index]);
    } else {
      // Other words begin with another tree, so that threads do not meet at the same counts.
      const std::int64_t groups = (words + kGroupWords<Grain> - 1) / kGroupWords<Grain>;
      const std::int64_t tree = (index + group * tree_count / groups) % tree_count;
      run_in_arrays<Grain>(trees[tree], group * Grain::kWords, counts[tree]);
    }
  }

 private:
  /// For few words: the result at hand stays in registers, and an operation is two masks, so that
  /// steps take no branch but for where operands come from.
  template <class Grain>
  HEWN_HD void run_in_registers(const TreeSpan& span, std::int64_t begin, TreeCounts& out) const {
    constexpr int kWords = Grain::kWords;
    constexpr int kGap = Grain::kGroup * kMovedWords;
    const TreeSpan tree = span;
    alignas(16) Word work[kWorkArrays][kWords];
    alignas(16) Word value[kWords] = {};
    alignas(16) Word b[kWords];
    const Word* const rows = columns + begin;
    const auto stride = static_cast<std::int32_t>(words * sizeof(Word));
    const TreeStep* next = steps + tree.first_step;
    OverlapWord* overlap = overlaps + (tree.first_overlap - overlaps_begin);
    for (std::int32_t done = 0; done < tree.steps; done += kStepsPerOverlapWord) {
      std::int32_t left = least(tree.steps - done, kStepsPerOverlapWord);
      OverlapWord overlapping = 0;
      OverlapWord bit = 1;
      for (; left > 0; --left, ++next, bit += bit) {
        const TwoHalves step = load<TwoHalves>(next);
        if (step.low >= 0) copy_words<kWords, kGap>(value, offset_by(rows, step.low >> 16, stride));
        if (step.high >= 0) {
          copy_words<kWords, kGap>(b, offset_by(rows, step.high >> 16, stride));
        } else if (is_complement(step)) {
          copy_words<kWords, kGap>(b, all + begin);
        } else {
          copy_words<kWords>(b, work[-1 - (step.high >> 16)]);
        }
        if (combine<kWords>(step.low, value, b) && !is_complement(step)) overlapping |= bit;
        if ((step.high & 0xff) != 0) copy_words<kWords>(work[step.low >> 8 & 0xff], value);
      }
      unite_into(overlap++, overlapping);
    }
    if (tree.value >= 0) copy_words<kWords, kGap>(value, offset_by(rows, tree.value, stride));
    copy_words<kWords, kGap>(b, wanted + begin);
    count(value, b, kWords, out);
  }

  /// A step as it lies in memory, least byte first: devices take it apart more quickly like this.
  /// The operands are at the top, so that the signs are theirs.
  struct alignas(8) TwoHalves {
    std::int32_t low, high;
  };
  static_assert(sizeof(TwoHalves) == sizeof(TreeStep) && offsetof(TreeStep, a) == 2 &&
                offsetof(TreeStep, is_kept) == 4 && offsetof(TreeStep, b) == 6);
  static HEWN_HD bool is_complement(const TwoHalves& step) { return (step.low & 4) != 0; }

  /// Puts the result in the place of `a`, and tells whether the operands have a row in common.
  ///
  /// The majority of a, b and a mask is the intersection or the union; what that has other than b
  /// is b without a, or a without b.
  template <int kWords>
  static HEWN_HD bool combine(std::int32_t op, Word* a, const Word* b) {
    const Word majority = mask_of(op << 31);
    const Word turn = mask_of(op << 30);
    Word common = 0;
    for (int k = 0; k < kWords; ++k) {
      common |= a[k] & b[k];
      a[k] = ((a[k] & b[k]) | (majority & (a[k] | b[k]))) ^ (turn & b[k]);
    }
    return common != 0;
  }
  /// All bits where `bits` is negative, else none.
  static HEWN_HD Word mask_of(std::int32_t bits) {
    const auto half = static_cast<std::uint32_t>(bits >> 31);
    return static_cast<Word>(half) << 32 | half;
  }
  static HEWN_HD std::int32_t least(std::int32_t a, std::int32_t b) { return a < b ? a : b; }

  /// For many words: each step runs over all of them.
  template <class Grain>
  HEWN_HD void run_in_arrays(const TreeSpan& tree, std::int64_t begin, TreeCounts& out) const {
    const int length =
        words - begin >= Grain::kWords ? Grain::kWords : static_cast<int>(words - begin);
    alignas(Grain::kBlock * sizeof(Word)) Word work[kWorkArrays * Grain::kWords];
    const Word* value = nullptr;
    const auto place = [&](TreeOperand operand) -> const Word* {
      if (operand >= 0) return columns + operand * words + begin;
      return operand == kPreviousResult ? value : work + (-1 - operand) * Grain::kWords;
    };
    OverlapWord overlapping = 0;
    for (std::int32_t i = 0; i < tree.steps; ++i) {
      const TreeStep step = steps[tree.first_step + i];
      Word* target = work + step.target * Grain::kWords;
      const Word* b = step.op == TreeOp::Complement ? all + begin : place(step.b);
      const std::int32_t bit = i % kStepsPerOverlapWord;
      if (apply<Grain>(step.op, place(step.a), b, target, length)) {
        overlapping |= OverlapWord{1} << bit;
      }
      value = target;
      if (bit != kStepsPerOverlapWord - 1 && i + 1 != tree.steps) continue;
      unite_into(overlaps + (tree.first_overlap - overlaps_begin) + i / kStepsPerOverlapWord,
                 overlapping);
      overlapping = 0;
    }
    count(place(tree.value), wanted + begin, length, out);
  }

  /// Whether the operands have a row in common.
  template <class Grain>
  static HEWN_HD bool apply(TreeOp op, const Word* a, const Word* b, Word* out, int length) {
    switch (op) {
      case TreeOp::Union:
        return join<Grain>(a, b, out, length, [](Word x, Word y) { return x | y; });
      case TreeOp::Intersection:
        return join<Grain>(a, b, out, length, [](Word x, Word y) { return x & y; });
      case TreeOp::Difference:
        return join<Grain>(a, b, out, length, [](Word x, Word y) { return x & ~y; });
      case TreeOp::ReverseDifference:
        return join<Grain>(a, b, out, length, [](Word x, Word y) { return y & ~x; });
      case TreeOp::Complement:
        join<Grain>(a, b, out, length, [](Word x, Word y) { return y & ~x; });
        return false;
    }
    return false;
  }

  template <class Grain, class Op>
  static HEWN_HD bool join(const Word* a, const Word* b, Word* out, int length, const Op& op) {
    Word common[Grain::kBlock] = {};
    for (int begin = 0; begin < length; begin += Grain::kBlock) {
      // All is read before anything is written: `out` may be an operand.
      Word result[Grain::kBlock];
      for (int i = 0; i < Grain::kBlock; ++i) {
        common[i] |= a[begin + i] & b[begin + i];
        result[i] = op(a[begin + i], b[begin + i]);
      }
      for (int i = 0; i < Grain::kBlock; ++i) out[begin + i] = result[i];
    }
    Word any = 0;
    for (const Word c : common) any |= c;
    return any != 0;
  }

  static HEWN_HD void count(const Word* value, const Word* wanted_value, int length,
                            TreeCounts& out) {
    int held = 0;
    int held_wanted = 0;
    for (int i = 0; i < length; ++i) {
      held += count_bits(value[i]);
      held_wanted += count_bits(value[i] & wanted_value[i]);
    }
    sum_into(&out.held, held);
    sum_into(&out.held_wanted, held_wanted);
  }
};

}  // namespace hewn
