#pragma once
/// Single literals exchanged for others that do the same where it matters but overlap more.
#include "core/base/run_context.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

/// A formula of the same size that agrees with the input on every cell of `care`, with a proximity
/// that no exchange of one literal improves: a bore that ends where a pin closes it again overlaps
/// what the pin stands in. Cost: O(rounds x leaves x literals x words), and a measurement of the
/// proximity for each literal that may take another's place. Stops early when cancelled.
Formula exchange_literals(Formula formula, const CellColumns& cells, const Column& care,
                          const RunContext& run);

}  // namespace hewn
