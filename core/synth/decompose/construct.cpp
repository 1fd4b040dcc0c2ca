#include "core/synth/decompose/construct.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "core/synth/decompose/grower_team.h"

namespace hewn {
namespace {

constexpr double kUnresolvedWeight = 0.45;  // literals expected per unresolved face group
constexpr double kCellWeight = 2;           // a state's undecided share of cells, in groups
constexpr int kMaxDepth = 400;

/// A partly peeled solid.
struct State {
  std::vector<Word> open;        ///< cells that no item decides yet
  std::vector<Word> unresolved;  ///< per face group: pairs that no item separates yet
  std::vector<TermPtr> items;
  int cost = 0;
  double estimate = 0;  ///< of the final cost
};

struct Candidate {
  double score = 0;
  TermPtr term;
};

/// The pairs of a group with an end in the term.
Word pairs_touched(const ColumnTable& columns, const Term& term, std::size_t group) {
  Word inside = ~Word{0};
  Word outside = ~Word{0};
  for (const TermLiteral& l : term.literals) {
    inside &= columns.pair_word(static_cast<std::size_t>(l.halfspace), l.inside, group, 0);
    outside &= columns.pair_word(static_cast<std::size_t>(l.halfspace), l.inside, group, 1);
  }
  return inside | outside;
}

class Beam {
 public:
  Beam(const SearchSpace& space, const ConstructOptions& options, GrowerTeam& growers, Rng& rng,
       const RunContext& run)
      : space_(space),
        columns_(*space.columns),
        options_(options),
        growers_(growers),
        rng_(rng),
        run_(run) {}

  std::optional<DecisionList> run() {
    std::vector<State> states{first_state()};
    for (int depth = 0; depth < kMaxDepth && !states.empty(); ++depth) {
      std::vector<State> next;
      for (const State& state : states) {
        if (run_.is_cancelled()) return std::nullopt;
        expand(state, next);
      }
      std::stable_sort(next.begin(), next.end(),
                       [](const State& a, const State& b) { return a.estimate < b.estimate; });
      if (next.size() > static_cast<std::size_t>(options_.beam_width)) {
        next.resize(static_cast<std::size_t>(options_.beam_width));
      }
      states = std::move(next);
    }
    return best_;
  }

 private:
  State first_state() const {
    State s;
    s.open = space_.care;
    for (std::size_t g = 0; g < columns_.groups(); ++g)
      s.unresolved.push_back(columns_.pair_mask(g));
    return s;
  }

  double unresolved_groups(const State& s) const {
    double total = 0;
    for (std::size_t g = 0; g < columns_.groups(); ++g) {
      total += static_cast<double>(std::popcount(s.unresolved[g])) /
               std::max(1, std::popcount(columns_.pair_mask(g)));
    }
    return total;
  }

  /// Keeps the finished list when it is the best; true when nothing is left to decide.
  bool finish(const State& s, const std::vector<std::size_t> (&cells)[2]) {
    if (!cells[0].empty() && !cells[1].empty()) return false;
    DecisionList list{s.items, !cells[1].empty()};
    if (!best_ || list.cost() < best_->cost()) best_ = std::move(list);
    return true;
  }

  void expand(const State& state, std::vector<State>& next) {
    std::vector<std::size_t> cells[2];
    for_each_bit(state.open, [&](std::size_t c) {
      cells[test_bit(columns_.wanted().data(), c) ? 1 : 0].push_back(c);
    });
    if (finish(state, cells) || (best_ && state.cost + 1 >= best_->cost())) return;
    std::vector<Candidate> candidates = grow_candidates(state, cells);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.score > b.score; });
    const std::size_t width =
        std::min(candidates.size(), static_cast<std::size_t>(options_.beam_width));
    for (std::size_t k = 0; k < width; ++k) {
      State child = apply(state, candidates[k].term);
      const std::uint64_t hash = hash_words(child.open);
      const auto [known, is_new] = cheapest_.try_emplace(hash, child.cost);
      if (!is_new && known->second <= child.cost) continue;
      known->second = child.cost;
      next.push_back(std::move(child));
    }
  }

  /// What to grow from a state: as many filling terms as cutting ones.
  const std::vector<GrowRequest>& draw_requests(const std::vector<std::size_t> (&cells)[2]) {
    requests_.clear();
    for (int k = 0; k < 2 * options_.seeds; ++k) {
      GrowRequest request;
      request.fills = (k & 1) != 0;
      request.noise = k < 8 ? 0 : options_.noise;
      request.mode = static_cast<GrowMode>(k < options_.seeds ? (k >> 1) % 4
                                                              : static_cast<int>(rng_.below(4)));
      const auto& pool = cells[request.fills ? 1 : 0];
      request.seed = pool[rng_.below(pool.size())];
      request.random = rng_.next();
      requests_.push_back(request);
    }
    return requests_;
  }

  std::vector<Candidate> grow_candidates(const State& state,
                                         const std::vector<std::size_t> (&cells)[2]) {
    std::vector<Candidate> candidates;
    std::unordered_set<std::uint64_t> seen;
    const int open_cells = static_cast<int>(cells[0].size() + cells[1].size());
    std::vector<Word> effect(space_.words());
    for (std::optional<Term>& term : growers_.grow(draw_requests(cells), state.open)) {
      if (!term) continue;
      for (std::size_t i = 0; i < effect.size(); ++i) effect[i] = term->cover[i] & state.open[i];
      if (!seen.insert(hash_words(effect, term->fills ? 1 : 0)).second) continue;
      const int decided = bit_kernels().count(effect.data(), effect.size());
      const double value = resolved_groups(state, *term) + kCellWeight * decided / open_cells;
      candidates.push_back(
          {(value + 0.001) / term->cost, std::make_shared<const Term>(std::move(*term))});
    }
    return candidates;
  }

  double resolved_groups(const State& state, const Term& term) const {
    double total = 0;
    for (std::size_t g = 0; g < columns_.groups(); ++g) {
      if (state.unresolved[g] == 0) continue;
      const Word touched = state.unresolved[g] & pairs_touched(columns_, term, g);
      total += static_cast<double>(std::popcount(touched)) / std::popcount(columns_.pair_mask(g));
    }
    return total;
  }

  State apply(const State& state, const TermPtr& term) const {
    State child = state;
    for (std::size_t i = 0; i < child.open.size(); ++i) child.open[i] &= ~term->cover[i];
    for (std::size_t g = 0; g < columns_.groups(); ++g) {
      if (child.unresolved[g] != 0) child.unresolved[g] &= ~pairs_touched(columns_, *term, g);
    }
    child.items.push_back(term);
    child.cost += term->cost;
    const int rest = bit_kernels().count(child.open.data(), child.open.size());
    const double remaining =
        unresolved_groups(child) + kCellWeight * rest / static_cast<double>(columns_.cells());
    child.estimate = child.cost + kUnresolvedWeight * remaining;
    return child;
  }

  const SearchSpace& space_;
  const ColumnTable& columns_;
  const ConstructOptions& options_;
  GrowerTeam& growers_;
  Rng& rng_;
  const RunContext& run_;
  std::vector<GrowRequest> requests_;
  std::optional<DecisionList> best_;
  std::unordered_map<std::uint64_t, int> cheapest_;  // looked up only, never iterated
};

}  // namespace

std::optional<DecisionList> construct_list(const SearchSpace& space,
                                           const ConstructOptions& options, GrowerTeam& growers,
                                           Rng& rng, const RunContext& run) {
  std::optional<DecisionList> list = Beam(space, options, growers, rng, run).run();
  if (list) drop_redundant_items(space, list->items, list->base);
  return list;
}

}  // namespace hewn
