#pragma once
/// The first decision list: beam search that peels the solid with pure terms.
#include <optional>

#include "core/base/rng.h"
#include "core/base/run_context.h"
#include "core/synth/decompose/decision_list.h"

namespace hewn {

class GrowerTeam;

struct ConstructOptions {
  int beam_width = 6;
  int seeds = 24;       ///< terms grown per state and kind
  double noise = 0.15;  ///< of the gains, for variety among starts
};

/// A right list; nullopt when the beam dies out (contradictory cells) or the run is cancelled.
/// Cost: O(items x width x seeds) grown terms.
std::optional<DecisionList> construct_list(const SearchSpace& space,
                                           const ConstructOptions& options, GrowerTeam& growers,
                                           Rng& rng, const RunContext& run);

}  // namespace hewn
