#pragma once
/// Where the value of an operand matters, given the other operands.
#include <cstddef>

#include "core/synth/simplify/formula.h"

namespace hewn {

/// The cells of `care` in which the operation's value follows its operand `child`: those that the
/// other operands do not decide. Cost: O(operands x words).
Column care_of_child(const Formula& parent, std::size_t child, const Column& care);

/// The same for all operands of one operation. The formula must outlive it.
class SiblingCare {
 public:
  /// Cost: O(operands x words).
  explicit SiblingCare(const Formula& parent) : parent_(parent) { renew(); }

  /// After a change of an operand's value.
  void renew();
  /// Cost: O(words).
  Column of(std::size_t child, const Column& care) const;

 private:
  Word decided(std::size_t child, std::size_t word) const;

  const Formula& parent_;
  Column once_, twice_;  ///< cells that one operand decides; that another one decides, too
};

}  // namespace hewn
