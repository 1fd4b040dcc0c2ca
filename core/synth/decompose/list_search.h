#pragma once
/// The search for a cheap decision list: several independent constructions, the better of which are
/// refined for longer and longer.
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/run_context.h"
#include "core/synth/decompose/decision_list.h"
#include "core/synth/decompose/neighbourhood.h"

namespace hewn {

/// A right list with what it leaves out of account.
struct FoundList {
  DecisionList list;
  bool clip = false;  ///< outside the frame's box nothing was asked of the list
  int cost() const { return list.cost() + (clip && !list.base ? 1 : 0); }
  bool is_clipped() const { return clip || list.base; }
};

/// Budgets count steps, never time, so that results do not depend on the machine's speed.
struct ListSearchOptions {
  int starts = 6;
  int beam_width = 6;
  int neighbourhood_steps = 2500;  ///< stop after this many without improvement
  int first_share = 4;             ///< of a full walk: the first one of each construction
  int regrow_tries = 10;
  bool may_clip = true;  ///< every other start is asked about the frame's box only
  /// Ends early, without a list, when none as cheap as this is to be expected; 0: never.
  int most_cost = 0;
};

/// One search over the cells of a round. Same result for any number of threads.
class ListSearch {
 public:
  using Progress = std::function<void(double share)>;
  using Found = std::function<void(const FoundList& list)>;

  /// `spaces`: everywhere; inside the frame's box only. The references must outlive it. `stream`
  /// selects the random numbers; a thousand following ones are used.
  ListSearch(const std::array<SearchSpace, 2>& spaces, const ListSearchOptions& options,
             std::uint64_t stream, const RunContext& run)
      : spaces_(spaces), options_(options), stream_(stream), run_(run) {}

  /// Lets `sink` know of every list that is cheaper than those before it, while `construct` runs;
  /// from its threads, also at the same time.
  void on_found(Found sink) { on_found_ = std::move(sink); }

  /// The cheapest list found; nullopt when no construction succeeds, the run is cancelled, or the
  /// search ends early.
  std::optional<FoundList> construct(const Progress& progress);

  /// Mends a list that has become wrong and walks on from it. False when that fails.
  bool repair(FoundList& found);

  long terms_grown() const { return terms_grown_; }

 private:
  double effort() const;
  bool is_hopeless(const FoundList& list, double rest) const;
  std::optional<FoundList> start(std::size_t i, long& grown);
  std::vector<FoundList> start_all(const Progress& progress);
  NeighbourhoodOptions walk_options(const DecisionList& list, int share) const;
  void tell(const DecisionList& list, bool clip);
  void refine(int task, int share, std::vector<FoundList>& lists);

  const std::array<SearchSpace, 2>& spaces_;
  const ListSearchOptions& options_;
  std::uint64_t stream_;
  const RunContext& run_;
  long terms_grown_ = 0;
  Found on_found_;
  std::mutex mutex_;
  int cheapest_told_ = std::numeric_limits<int>::max();
};

}  // namespace hewn
