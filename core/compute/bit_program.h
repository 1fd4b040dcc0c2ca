#pragma once
/// Boolean formulas over bit columns, evaluated block by block: one candidate tree against all
/// points at once. Background: docs/benchmarks.md, "bits against floats".
#include <cstdint>
#include <span>
#include <vector>

#include "core/compute/bits.h"

namespace hewn {

/// `AndNot` is the first operand without the second; `Not` takes one operand.
enum class BitOp : std::uint8_t { And, Or, AndNot, Not };

/// Where a step finds a value: a column of the caller's, or the result of an earlier step.
struct BitOperand {
  bool is_column = true;
  int index = 0;  ///< of the column, or of the scratch slot

  bool operator==(const BitOperand&) const = default;
};

/// One operation; its result goes to a scratch slot. A slot that holds an operand may be the
/// target, too. `b == a` for `BitOp::Not`.
struct BitStep {
  BitOp op = BitOp::And;
  BitOperand a, b;
  int slot = 0;
};

/// A formula in postfix order, for any number of evaluations. Thread-safe once it is complete.
class BitProgram {
 public:
  /// Words evaluated at a time: small enough for all intermediate results to stay in the first
  /// cache, large enough to hide the cost of decoding a step. A multiple of `kWordBlock`.
  static constexpr std::size_t kBlockWords = 128;

  /// Pushes a column's value. Requires: `column >= 0`.
  void push_column(int column);
  /// Replaces the topmost two values (one for `Not`) by the operation's result; the topmost is the
  /// second operand. Requires: so many values.
  void push_op(BitOp op);

  /// Exactly one value is left: the formula's.
  bool is_complete() const { return stack_.size() == 1; }
  /// 1 + the largest column index.
  int columns_needed() const { return columns_needed_; }
  /// Scratch slots that the steps use.
  int slots_needed() const { return slots_needed_; }
  const std::vector<BitStep>& steps() const { return steps_; }
  /// Where the formula's value is after the last step. Requires: `is_complete()`.
  BitOperand result() const { return stack_.back().operand; }

  /// For how many of the first `bits` bits the formula's value differs from `wanted`.
  ///
  /// Requires: `is_complete()`; `columns.size() >= columns_needed()`; all columns and `wanted` have
  /// `padded_words(bits)` words with zeros beyond `bits`.
  /// The same number on every path. Cost: O(steps x words).
  int count_differing(std::span<const Word* const> columns, const Word* wanted,
                      std::size_t bits) const;
  /// The same on a given path, for tests and benchmarks. Requires: `bit_kernels(path) != nullptr`.
  int count_differing(std::span<const Word* const> columns, const Word* wanted, std::size_t bits,
                      BitPath path) const;

 private:
  /// A value on the stack while the formula is read.
  struct Value {
    BitOperand operand;
    bool of_zeros = false;  ///< the value when every column is zero, as in the padding
  };
  int free_slot() const;

  std::vector<BitStep> steps_;
  std::vector<Value> stack_;
  int columns_needed_ = 0;
  int slots_needed_ = 0;
};

}  // namespace hewn
