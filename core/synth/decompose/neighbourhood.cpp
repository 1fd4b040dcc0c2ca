#include "core/synth/decompose/neighbourhood.h"

#include <algorithm>
#include <cmath>

#include "core/base/assert.h"
#include "core/synth/decompose/grower_team.h"

namespace hewn {
namespace {

constexpr double kRegrowNoise = 0.5;
constexpr int kCommuteMoves = 3;
constexpr std::size_t kLargestWindow = 5;
constexpr std::size_t kWidestBlock = 7;
constexpr int kRepairTries = 16;
constexpr int kMaxRepairs = 400;

struct Window {
  std::size_t begin = 0, end = 0;
};

/// The term with the highest score, taken out of the batch; null when none has more than 0.
template <class Score>
TermPtr best_of(std::span<std::optional<Term>> terms, const Score& score) {
  double highest = 0;
  std::optional<Term>* best = nullptr;
  for (std::optional<Term>& term : terms) {
    const double value = term ? score(*term) : 0;
    if (value <= highest) continue;
    highest = value;
    best = &term;
  }
  return best != nullptr ? std::make_shared<const Term>(std::move(**best)) : nullptr;
}

/// Takes single steps through the neighbourhood of a list.
class Stepper {
 public:
  Stepper(const SearchSpace& space, const NeighbourhoodOptions& options, Rng& rng,
          const RunContext& run)
      : space_(space),
        options_(options),
        rng_(rng),
        growers_(*space.columns, *space.combinability, run) {}

  /// Tries one window of `list`; puts what is no worse in its place. False when nothing was found.
  bool take_step(DecisionList& list) {
    std::vector<TermPtr> items = list.items;
    commute(items);
    Window window = random_window(items.size());
    if (items.size() > 3 && rng_.coin()) gather_related(items, window);
    std::vector<TermPtr> replacement;
    if (!solve_window(items, list.base, window, replacement)) return false;
    std::vector<TermPtr> result(items.begin(), items.begin() + static_cast<long>(window.begin));
    result.insert(result.end(), replacement.begin(), replacement.end());
    result.insert(result.end(), items.begin() + static_cast<long>(window.end), items.end());
    HEWN_ASSERT(is_right(space_, result, list.base), "windows are solved for all that they decide");
    drop_redundant_items(space_, result, list.base);
    DecisionList changed{std::move(result), list.base};
    if (changed.cost() > list.cost()) return false;
    list = std::move(changed);
    return true;
  }

  long terms_grown() const { return growers_.terms_grown(); }

 private:
  /// Moves an item as long as the list stays right.
  bool try_move(std::vector<TermPtr>& items, std::size_t from, std::size_t to) {
    to = std::min(to, items.size() - 1);
    if (!may_move(items, from, to)) return false;
    const auto begin = items.begin();
    const auto at = [&](std::size_t k) { return begin + static_cast<long>(k); };
    if (from < to) {
      std::rotate(at(from), at(from + 1), at(to + 1));
    } else {
      std::rotate(at(to), at(from), at(from + 1));
    }
    return true;
  }

  /// Whether a list that is right stays so: the item moved and those that it passes must agree on
  /// the cells that the one ahead decides. Few blocks hold any cell of the item.
  bool may_move(const std::vector<TermPtr>& items, std::size_t from, std::size_t to) const {
    const Term& item = *items[from];
    const std::size_t first_passed = from < to ? from + 1 : to;
    const std::size_t end_passed = from < to ? to + 1 : from;
    for (std::size_t block = 0; block < space_.words(); block += kWordBlock) {
      Word cells[kWordBlock];
      Word any = 0;
      for (std::size_t i = 0; i < kWordBlock; ++i) {
        cells[i] = item.cover[block + i] & space_.care[block + i];
        any |= cells[i];
      }
      const auto drop = [&](const Term& other) {
        const Word* cover = other.cover.data() + block;
        any = 0;
        for (std::size_t i = 0; i < kWordBlock; ++i) {
          cells[i] &= ~cover[i];
          any |= cells[i];
        }
      };
      for (std::size_t k = 0; k < std::min(from, to) && any != 0; ++k) drop(*items[k]);
      for (std::size_t k = first_passed; k < end_passed && any != 0; ++k) {
        const Word* cover = items[k]->cover.data() + block;
        Word shared = 0;
        for (std::size_t i = 0; i < kWordBlock; ++i) shared |= cells[i] & cover[i];
        if (shared == 0) continue;
        if (items[k]->fills != item.fills) return false;
        drop(*items[k]);
      }
    }
    return true;
  }

  void commute(std::vector<TermPtr>& items) {
    if (items.size() < 2) return;
    for (int k = 0; k < kCommuteMoves; ++k) {
      const std::size_t from = rng_.below(items.size());
      const std::size_t to = rng_.below(items.size());
      try_move(items, from, to);
    }
  }

  Window random_window(std::size_t n) {
    const std::size_t width = 1 + rng_.below(std::min(n, kLargestWindow));
    const std::size_t begin = rng_.below(n - width + 1);
    return {begin, begin + width};
  }

  /// Brings items that share halfspaces or cells with a random one together into one window.
  void gather_related(std::vector<TermPtr>& items, Window& window) {
    const Term* key = items[rng_.below(items.size())].get();
    std::vector<std::pair<double, const Term*>> related;
    for (const TermPtr& item : items) {
      if (item.get() != key) related.emplace_back(relatedness(*item, *key), item.get());
    }
    std::stable_sort(related.begin(), related.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    const std::size_t wanted = std::min<std::size_t>(1 + rng_.below(4), related.size());
    std::vector<const Term*> block{key};
    for (std::size_t k = 0; k < wanted; ++k) {
      const Term* item = related[k].second;
      const std::size_t at = index_of(items, key);
      const std::size_t from = index_of(items, item);
      const std::size_t to = from < at ? at - 1 : at + block.size();
      if (try_move(items, from, to)) block.push_back(item);
    }
    std::size_t lo = items.size();
    std::size_t hi = 0;
    for (const Term* item : block) {
      lo = std::min(lo, index_of(items, item));
      hi = std::max(hi, index_of(items, item));
    }
    if (hi - lo < kWidestBlock) window = {lo, hi + 1};
  }

  double relatedness(const Term& a, const Term& b) {
    int shared = 0;
    for (const TermLiteral& x : a.literals) {
      for (const TermLiteral& y : b.literals) shared += x.halfspace == y.halfspace ? 1 : 0;
    }
    const int overlap = bit_kernels().count_and(a.cover.data(), b.cover.data(), a.cover.size());
    return shared + 0.5 * std::log(1.0 + overlap) + 3 * rng_.uniform();
  }

  static std::size_t index_of(const std::vector<TermPtr>& items, const Term* item) {
    const auto is_it = [item](const TermPtr& other) { return other.get() == item; };
    return static_cast<std::size_t>(std::find_if(items.begin(), items.end(), is_it) -
                                    items.begin());
  }

  /// Finds terms that decide what the window decided, at no higher cost.
  bool solve_window(const std::vector<TermPtr>& items, bool base, const Window& window,
                    std::vector<TermPtr>& replacement) {
    open_ = space_.care;
    for (std::size_t k = 0; k < window.begin; ++k) {
      for (std::size_t i = 0; i < open_.size(); ++i) open_[i] &= ~items[k]->cover[i];
    }
    required_.resize(space_.words());
    evaluate_list({items.data() + window.end, items.size() - window.end}, base, required_);
    const std::vector<Word>& wanted = space_.columns->wanted();
    for (std::size_t i = 0; i < required_.size(); ++i) {
      required_[i] = (required_[i] ^ wanted[i]) & open_[i];
    }
    int budget = 0;
    for (std::size_t k = window.begin; k < window.end; ++k) budget += items[k]->cost;
    for (;;) {
      cells_.clear();
      for_each_bit(required_, [this](std::size_t c) { cells_.push_back(c); });
      if (cells_.empty()) return true;
      TermPtr best = best_regrown(budget);
      if (!best) return false;
      budget -= best->cost;
      for (std::size_t i = 0; i < open_.size(); ++i) {
        open_[i] &= ~best->cover[i];
        required_[i] &= ~best->cover[i];
      }
      replacement.push_back(std::move(best));
    }
  }

  GrowRequest draw_request(int budget) {
    GrowRequest request;
    request.seed = cells_[rng_.below(cells_.size())];
    request.fills = test_bit(space_.columns->wanted().data(), request.seed);
    request.gains_required = rng_.below(4) != 0;
    request.noise = kRegrowNoise;
    request.max_cost = budget;
    request.mode = static_cast<GrowMode>(rng_.below(4));
    request.random = rng_.next();
    return request;
  }

  /// The regrown term that decides the most required cells per cost, none dearer than `budget`.
  TermPtr best_regrown(int budget) {
    if (budget <= 0) return nullptr;
    requests_.clear();
    for (int k = 0; k < options_.regrow_tries; ++k) requests_.push_back(draw_request(budget));
    return best_of(growers_.grow(requests_, open_, &required_), [&](const Term& term) {
      if (term.cost > budget) return 0.0;
      const int decided =
          bit_kernels().count_and(term.cover.data(), required_.data(), required_.size());
      return decided * (1 + 0.3 * (rng_.uniform() - 0.5)) / term.cost;
    });
  }

  const SearchSpace& space_;
  const NeighbourhoodOptions& options_;
  Rng& rng_;
  GrowerTeam growers_;
  std::vector<GrowRequest> requests_;
  std::vector<Word> open_, required_;
  std::vector<std::size_t> cells_;
};

}  // namespace

WalkReport improve_list(const SearchSpace& space, const NeighbourhoodOptions& options,
                        DecisionList& list, Rng& rng, const RunContext& run) {
  Stepper stepper(space, options, rng, run);
  WalkReport report;
  int stall = 0;
  for (; report.steps < options.steps && stall < options.stall_steps; ++report.steps) {
    if (list.items.empty() || run.should_stop()) break;
    const int cost = list.cost();
    const bool is_better = stepper.take_step(list) && list.cost() < cost;
    stall = is_better ? 0 : stall + 1;
  }
  report.terms_grown = stepper.terms_grown();
  return report;
}

bool repair_list(const SearchSpace& space, DecisionList& list, GrowerTeam& growers, Rng& rng,
                 const RunContext& run) {
  std::vector<GrowRequest> requests(kRepairTries);
  for (int round = 0; round < kMaxRepairs; ++round) {
    const std::vector<Word> wrong = wrong_cells(space, list.items, list.base);
    std::vector<std::size_t> cells;
    for_each_bit(wrong, [&](std::size_t c) { cells.push_back(c); });
    if (cells.empty()) return true;
    if (run.is_cancelled()) return false;
    for (GrowRequest& request : requests) {
      request.seed = cells[rng.below(cells.size())];
      request.fills = test_bit(space.columns->wanted().data(), request.seed);
      request.gains_required = rng.coin();
      request.noise = 0.4;
      request.mode = static_cast<GrowMode>(rng.below(4));
      request.random = rng.next();
    }
    TermPtr best = best_of(growers.grow(requests, space.care, &wrong), [&](const Term& term) {
      const int mended = bit_kernels().count_and(term.cover.data(), wrong.data(), wrong.size());
      return static_cast<double>(mended) / term.cost;
    });
    if (!best) return false;
    list.items.insert(list.items.begin(), std::move(best));
  }
  return false;
}

}  // namespace hewn
