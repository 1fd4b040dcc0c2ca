#pragma once
/// Large neighbourhood search: commute items, cut a window, solve it again for the cells that it
/// must decide, keep the result when it is no worse.
#include "core/base/rng.h"
#include "core/base/run_context.h"
#include "core/synth/decompose/decision_list.h"

namespace hewn {

class GrowerTeam;

struct NeighbourhoodOptions {
  int steps = 400;        ///< tried windows at most
  int stall_steps = 400;  ///< stop after this many without improvement
  int regrow_tries = 10;  ///< terms grown per gap in a window
};

struct WalkReport {
  int steps = 0;
  long terms_grown = 0;
};

/// Improves a right list in place; it stays right.
WalkReport improve_list(const SearchSpace& space, const NeighbourhoodOptions& options,
                        DecisionList& list, Rng& rng, const RunContext& run);

/// Mends a list that has become wrong (new cells) by putting terms in front.
/// False when a wrong cell cannot be covered, and when the run is cancelled.
bool repair_list(const SearchSpace& space, DecisionList& list, GrowerTeam& growers, Rng& rng,
                 const RunContext& run);

}  // namespace hewn
