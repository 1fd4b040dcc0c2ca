#include "core/synth/decompose/list_search.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/compute/parallel.h"
#include "core/synth/decompose/construct.h"
#include "core/synth/decompose/grower_team.h"
#include "core/synth/decompose/pull_out.h"
#include "core/synth/decompose/rebase.h"

namespace hewn {
namespace {

/// Halfspaces x words of a problem that is still searched with full effort.
constexpr double kFullEffortWork = 2000;

/// What later walks leave of a list's cost at best, measured on the published trees: of a start's,
/// and after a walk of that share.
constexpr double kRestOfStart = 0.7;
constexpr double rest_after(int share) { return share >= 8 ? 0.75 : share >= 4 ? 0.8 : 0.87; }

void keep_cheapest(std::vector<FoundList>& lists, std::size_t count) {
  std::stable_sort(lists.begin(), lists.end(),
                   [](const FoundList& a, const FoundList& b) { return a.cost() < b.cost(); });
  lists.resize(std::min(count, lists.size()));
}

}  // namespace

/// In (0, 1]: less for problems whose terms take long to grow, so that large parts end in time.
double ListSearch::effort() const {
  const ColumnTable& columns = *spaces_[0].columns;
  const auto work = static_cast<double>(columns.halfspaces() * columns.words());
  return std::clamp(kFullEffortWork / work, 0.05, 1.0);
}

NeighbourhoodOptions ListSearch::walk_options(const DecisionList& list, int share) const {
  NeighbourhoodOptions o;
  const int full =
      std::min(40 + 20 * static_cast<int>(list.items.size()), options_.neighbourhood_steps);
  o.stall_steps = std::max(20, static_cast<int>(full * effort()) / share);
  o.steps = 4 * o.stall_steps;
  o.regrow_tries = options_.regrow_tries;
  return o;
}

bool ListSearch::is_hopeless(const FoundList& list, double rest) const {
  return options_.most_cost > 0 && rest * list.cost() > options_.most_cost;
}

/// One independent construction with a first short walk.
std::optional<FoundList> ListSearch::start(std::size_t i, long& grown) {
  const bool clip = (i & 1) != 0 && options_.may_clip;
  const SearchSpace& space = spaces_[clip ? 1 : 0];
  Rng rng(run_.seed, stream_ + i);
  GrowerTeam growers(*space.columns, *space.combinability, run_);
  ConstructOptions o;
  o.beam_width = std::max(2, static_cast<int>(options_.beam_width * std::sqrt(effort())));
  o.seeds = std::max(8, static_cast<int>(o.seeds * std::sqrt(effort())));
  o.noise = i < 2 ? 0.15 : 0.4;
  std::optional<DecisionList> list = construct_list(space, o, growers, rng, run_);
  grown = growers.terms_grown();
  if (!list) return std::nullopt;
  rebase_list(space, *list);
  tell(*list, clip);
  grown +=
      improve_list(space, walk_options(*list, options_.first_share), *list, rng, run_).terms_grown;
  tell(*list, clip);
  return FoundList{std::move(*list), clip};
}

/// All constructions that succeed; none when the first one is hopeless.
std::vector<FoundList> ListSearch::start_all(const Progress& progress) {
  const std::size_t starts = static_cast<std::size_t>(std::max(1, options_.starts));
  std::vector<std::optional<FoundList>> found(starts);
  std::vector<long> grown(starts, 0);
  std::atomic<int> ended{0};
  const auto begin = [&](std::size_t i) {
    // Past a time limit one construction has to do; the first two differ in what they are asked.
    if (i > 1 && run_.should_stop()) return;
    found[i] = start(i, grown[i]);
    progress(0.8 * ++ended / static_cast<double>(starts));
  };
  // Where the search may end early, the first one tells alone whether others are worth their time.
  const std::size_t alone = options_.most_cost > 0 ? 1 : 0;
  if (alone > 0) begin(0);
  if (!found[0] || !is_hopeless(*found[0], kRestOfStart)) {
    for_each_index(run_.threads, starts - alone, [&](std::size_t i) { begin(alone + i); });
  } else {
    found[0].reset();
  }
  for (const long g : grown) terms_grown_ += g;
  std::vector<FoundList> lists;
  for (auto& f : found) {
    if (f) lists.push_back(std::move(*f));
  }
  return lists;
}

std::optional<FoundList> ListSearch::construct(const Progress& progress) {
  std::vector<FoundList> lists = start_all(progress);
  // Successive halving: fewer and fewer, for longer and longer; in pairs, which two threads share.
  int task = 100;
  for (int share = options_.first_share; share >= 1 && !lists.empty(); share /= 2) {
    keep_cheapest(lists, (lists.size() + 3) / 4 * 2);
    refine(task, share, lists);
    task += 100;
    if (share == 1) break;
    std::erase_if(lists, [&](const FoundList& f) { return is_hopeless(f, rest_after(share)); });
  }
  if (lists.empty()) return std::nullopt;
  keep_cheapest(lists, 1);
  return std::move(lists.front());
}

void ListSearch::tell(const DecisionList& list, bool clip) {
  if (!on_found_) return;
  const FoundList found{list, clip};
  {
    const std::lock_guard lock(mutex_);
    if (found.cost() >= cheapest_told_) return;
    cheapest_told_ = found.cost();
  }
  on_found_(found);  // others go on meanwhile
}

/// Walks from every list, in parallel.
void ListSearch::refine(int task, int share, std::vector<FoundList>& lists) {
  std::vector<long> grown(lists.size(), 0);
  for_each_index(run_.threads, lists.size(), [&](std::size_t i) {
    FoundList& f = lists[i];
    const SearchSpace& space = spaces_[f.clip ? 1 : 0];
    Rng rng(run_.seed, stream_ + static_cast<std::uint64_t>(task) + i);
    grown[i] = improve_list(space, walk_options(f.list, share), f.list, rng, run_).terms_grown;
    rebase_list(space, f.list);
    pull_out_cuts(space, f.list);
  });
  for (const long g : grown) terms_grown_ += g;
}

bool ListSearch::repair(FoundList& found) {
  const SearchSpace& space = spaces_[found.is_clipped() ? 1 : 0];
  for (TermPtr& item : found.list.items) item = with_cover(*space.columns, *item);
  Rng rng(run_.seed, stream_ + 200);
  GrowerTeam growers(*space.columns, *space.combinability, run_);
  if (!repair_list(space, found.list, growers, rng, run_)) return false;
  terms_grown_ += growers.terms_grown();
  std::vector<FoundList> walks(2, found);
  refine(500, 2, walks);
  keep_cheapest(walks, 1);
  found = std::move(walks.front());
  return true;
}

}  // namespace hewn
