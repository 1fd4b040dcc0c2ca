#pragma once
/// Many trees at once on bit columns: how many rows each gets right, and which operands overlap.
#include "core/compute/host_device.h"

namespace hewn {

enum class TreeOp : std::uint8_t { Union, Intersection, Difference, Complement };

/// An operand at or above 0 is a column, `kPreviousResult` that of the step before; any other is
/// work array -1 - operand.
using TreeOperand = std::int16_t;
inline constexpr TreeOperand kPreviousResult = -32768;

/// One operation; operands in work arrays may be overwritten by its result. `Complement` is all
/// rows but `b`, and has no `a`.
struct alignas(8) TreeStep {
  TreeOp op = TreeOp::Union;
  std::uint8_t target = 0;  ///< work array
  TreeOperand a = 0, b = 0;
  /// Whether a later step than the next reads the result: else it need not leave the registers.
  std::uint8_t is_kept = 0;
};

struct TreeSpan {
  std::int64_t first_step = 0;
  std::int64_t first_overlap = 0;  ///< word of the tree's first step in `overlaps`
  std::int32_t steps = 0;
  TreeOperand value = 0;  ///< where the tree's own value is after the last step
};

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
  const Word* all = nullptr;     ///< every row
  TreeCounts* counts = nullptr;  ///< out, one a tree; 0 at first
  /// Out: bit i of a tree's words tells that the operands of its step i have a row in common; 0 at
  /// first. Complements have no such bit.
  Word* overlaps = nullptr;
  std::int64_t overlaps_begin = 0;  ///< the word that `overlaps` starts with

  /// Neighbouring items take one tree on neighbouring words, and then the next tree on the same
  /// words, which are then in the nearest cache.
  template <class Grain>
  HEWN_HD std::int64_t items() const {
    constexpr std::int64_t kGroupWords = Grain::kWords * Grain::kGroup;
    return (words + kGroupWords - 1) / kGroupWords * Grain::kGroup * tree_count;
  }

  template <class Grain>
  HEWN_HD void run(std::int64_t item) const {
    const std::int64_t group = quotient(item / Grain::kGroup, tree_count);
    const std::int64_t index = item / Grain::kGroup - group * tree_count;
    const std::int64_t begin = (group * Grain::kGroup + item % Grain::kGroup) * Grain::kWords;
    if (begin >= words) return;
    if constexpr (Grain::kWords == Grain::kBlock) {
      run_in_registers<Grain::kWords>(trees[index], begin, counts[index]);
    } else {
      run_in_arrays<Grain>(trees[index], begin, counts[index]);
    }
  }

 private:
  /// For few words: the last result stays at hand, and steps do without branches where they can.
  template <int kWords>
  HEWN_HD void run_in_registers(const TreeSpan& span, std::int64_t begin, TreeCounts& out) const {
    const TreeSpan tree = span;
    alignas(16) Word work[kWorkArrays][kWords];
    alignas(16) Word last[kWords] = {};
    alignas(16) Word a[kWords];
    alignas(16) Word b[kWords];
    const Word* const rows = columns + begin;
    const auto stride = static_cast<std::int32_t>(words);
    const auto fetch = [&](std::int32_t operand, Word* to) {
      if (operand >= 0) {
        copy_words<kWords>(to, rows + wide_product(operand, stride));
      } else if (operand == kPreviousResult) {
        for (int i = 0; i < kWords; ++i) to[i] = last[i];
      } else {
        copy_words<kWords>(to, work[-1 - operand]);
      }
    };
    const TreeStep* next = steps + tree.first_step;
    Word* overlap = overlaps + (tree.first_overlap - overlaps_begin);
    for (std::int32_t done = 0; done < tree.steps; done += 64) {
      const std::int32_t chunk = tree.steps - done < 64 ? tree.steps - done : 64;
      Word overlapping = 0;
      Word bit = 1;
      for (std::int32_t i = 0; i < chunk; ++i, ++next, bit += bit) {
        const TreeStep step = load(next);
        const bool is_complement = step.op == TreeOp::Complement;
        if (is_complement) {
          copy_words<kWords>(a, all + begin);
        } else {
          fetch(step.a, a);
        }
        fetch(step.b, b);
        // a u b = not (not a and not b), a - b = a and not b.
        const Word turn_a = step.op == TreeOp::Union ? ~Word{0} : 0;
        const Word turn_b = step.op == TreeOp::Intersection ? 0 : ~Word{0};
        Word common = 0;
        for (int k = 0; k < kWords; ++k) {
          common |= a[k] & b[k];
          last[k] = ((a[k] ^ turn_a) & (b[k] ^ turn_b)) ^ turn_a;
        }
        if (step.is_kept != 0) copy_words<kWords>(work[step.target], last);
        if (common != 0 && !is_complement) overlapping |= bit;
      }
      unite_into(overlap++, overlapping);
    }
    fetch(tree.value, a);
    count(a, begin, kWords, out);
  }

  /// For many words: each step runs over all of them.
  template <class Grain>
  HEWN_HD void run_in_arrays(const TreeSpan& tree, std::int64_t begin, TreeCounts& out) const {
    const int length =
        words - begin >= Grain::kWords ? Grain::kWords : static_cast<int>(words - begin);
    alignas(Grain::kBlock * sizeof(Word)) Word work[kWorkArrays * Grain::kWords];
    const Word* last = nullptr;
    const auto place = [&](TreeOperand operand) -> const Word* {
      if (operand >= 0) return columns + operand * words + begin;
      return operand == kPreviousResult ? last : work + (-1 - operand) * Grain::kWords;
    };
    Word overlapping = 0;
    for (std::int32_t i = 0; i < tree.steps; ++i) {
      const TreeStep step = steps[tree.first_step + i];
      Word* target = work + step.target * Grain::kWords;
      const Word* a = step.op == TreeOp::Complement ? all + begin : place(step.a);
      if (apply<Grain>(step.op, a, place(step.b), target, length)) {
        overlapping |= Word{1} << (i & 63);
      }
      last = target;
      if ((i & 63) != 63 && i + 1 != tree.steps) continue;
      unite_into(overlaps + (tree.first_overlap - overlaps_begin) + (i >> 6), overlapping);
      overlapping = 0;
    }
    count(place(tree.value), begin, length, out);
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
      case TreeOp::Complement:
        join<Grain>(a, b, out, length, [](Word x, Word y) { return x & ~y; });
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

  HEWN_HD void count(const Word* value, std::int64_t begin, int length, TreeCounts& out) const {
    int held = 0;
    int held_wanted = 0;
    for (int i = 0; i < length; ++i) {
      held += count_bits(value[i]);
      held_wanted += count_bits(value[i] & wanted[begin + i]);
    }
    sum_into(&out.held, held);
    sum_into(&out.held_wanted, held_wanted);
  }
};

}  // namespace hewn
