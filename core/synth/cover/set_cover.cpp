#include "core/synth/cover/set_cover.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/rng.h"

namespace hewn {
namespace {

int count_common(const Column& a, const Column& b) {
  int n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) n += std::popcount(a[i] & b[i]);
  return n;
}

Column all_elements(const SetCoverProblem& problem) {
  Column all(padded_words(problem.elements), 0);
  for (std::size_t i = 0; i < problem.elements; ++i) set_bit(all.data(), i);
  return all;
}

void remove(Column& from, const Column& what) {
  for (std::size_t i = 0; i < from.size(); ++i) from[i] &= ~what[i];
}

bool is_empty(const Column& a) {
  return std::all_of(a.begin(), a.end(), [](Word w) { return w == 0; });
}

bool is_subset(const Column& a, const Column& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if ((a[i] & ~b[i]) != 0) return false;
  }
  return true;
}

SetCover finished(const SetCoverProblem& problem, std::vector<int> chosen) {
  std::sort(chosen.begin(), chosen.end());
  SetCover cover;
  Column open = all_elements(problem);
  for (const int k : chosen) {
    cover.cost += problem.costs[static_cast<std::size_t>(k)];
    remove(open, problem.sets[static_cast<std::size_t>(k)]);
  }
  cover.chosen = std::move(chosen);
  cover.is_complete = is_empty(open);
  return cover;
}

/// Adds the best set for its cost until nothing more can be covered.
void add_greedily(const SetCoverProblem& problem, Column open, std::vector<int>& chosen) {
  while (!is_empty(open)) {
    int best = -1;
    double best_gain = 0;
    for (std::size_t k = 0; k < problem.sets.size(); ++k) {
      const double gain =
          static_cast<double>(count_common(problem.sets[k], open)) / problem.costs[k];
      if (gain <= best_gain) continue;
      best_gain = gain;
      best = static_cast<int>(k);
    }
    if (best < 0) return;
    chosen.push_back(best);
    remove(open, problem.sets[static_cast<std::size_t>(best)]);
  }
}

/// The most expensive sets go first.
void drop_needless(const SetCoverProblem& problem, std::vector<int>& chosen) {
  std::stable_sort(chosen.begin(), chosen.end(), [&](int a, int b) {
    return problem.costs[static_cast<std::size_t>(a)] > problem.costs[static_cast<std::size_t>(b)];
  });
  for (std::size_t i = 0; i < chosen.size();) {
    Column others(padded_words(problem.elements), 0);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      const Column& set = problem.sets[static_cast<std::size_t>(chosen[k])];
      for (std::size_t w = 0; w < others.size() && k != i; ++w) others[w] |= set[w];
    }
    const bool is_needless = is_subset(problem.sets[static_cast<std::size_t>(chosen[i])], others);
    if (is_needless) chosen.erase(chosen.begin() + static_cast<std::ptrdiff_t>(i));
    if (!is_needless) ++i;
  }
}

/// Depth-first over the element with the fewest sets.
class BranchAndBound {
 public:
  BranchAndBound(const SetCoverProblem& problem, std::int64_t most_nodes, const RunContext& run)
      : problem_(problem), run_(run), left_(most_nodes) {
    containing_.resize(problem.elements);
    for (std::size_t k = 0; k < problem.sets.size(); ++k) {
      if (is_dominated(k)) continue;
      for_each_bit(problem.sets[k],
                   [&](std::size_t e) { containing_[e].push_back(static_cast<int>(k)); });
    }
    for (std::vector<int>& sets : containing_) {
      std::stable_sort(sets.begin(), sets.end(), [&](int a, int b) { return cost(a) < cost(b); });
    }
  }

  SetCover search(SetCover start) {
    best_ = std::move(start);
    visit(all_elements(problem_), 0);
    best_.is_optimal = best_.is_complete && left_ > 0 && !run_.should_stop();
    return std::move(best_);
  }

 private:
  int cost(int set) const { return problem_.costs[static_cast<std::size_t>(set)]; }

  /// Another set, no more expensive, has all of its elements.
  bool is_dominated(std::size_t k) const {
    for (std::size_t other = 0; other < problem_.sets.size(); ++other) {
      if (other == k || problem_.costs[other] > problem_.costs[k]) continue;
      if (!is_subset(problem_.sets[k], problem_.sets[other])) continue;
      const bool are_equal = is_subset(problem_.sets[other], problem_.sets[k]) &&
                             problem_.costs[other] == problem_.costs[k];
      if (!are_equal || other < k) return true;
    }
    return false;
  }

  /// Elements of which no two are in one set each need a set of their own. Also finds the element
  /// to branch on.
  int lower_bound(const Column& open, std::size_t& branch) const {
    int bound = 0;
    std::size_t fewest = problem_.sets.size() + 1;
    std::vector<std::pair<std::size_t, std::size_t>> order;
    for_each_bit(open, [&](std::size_t e) {
      order.emplace_back(containing_[e].size(), e);
      if (containing_[e].size() >= fewest) return;
      fewest = containing_[e].size();
      branch = e;
    });
    std::sort(order.begin(), order.end());
    Column touched(padded_words(problem_.elements), 0);
    for (const auto& [count, e] : order) {
      if (test_bit(touched.data(), e) || count == 0) continue;
      bound += cost(containing_[e].front());
      for (const int k : containing_[e]) {
        const Column& set = problem_.sets[static_cast<std::size_t>(k)];
        for (std::size_t w = 0; w < touched.size(); ++w) touched[w] |= set[w];
      }
    }
    return bound;
  }

  void visit(const Column& open, int spent) {
    if (--left_ <= 0 || run_.should_stop()) return;
    if (is_empty(open)) {
      if (best_.is_complete && spent >= best_.cost) return;
      best_ = finished(problem_, chosen_);
      return;
    }
    std::size_t branch = 0;
    const int bound = lower_bound(open, branch);
    if (best_.is_complete && spent + bound >= best_.cost) return;
    for (const int k : containing_[branch]) {
      Column rest = open;
      remove(rest, problem_.sets[static_cast<std::size_t>(k)]);
      chosen_.push_back(k);
      visit(rest, spent + cost(k));
      chosen_.pop_back();
    }
  }

  const SetCoverProblem& problem_;
  const RunContext& run_;
  std::int64_t left_;
  std::vector<std::vector<int>> containing_;  ///< by element, cheapest first
  std::vector<int> chosen_;
  SetCover best_;
};

}  // namespace

SetCover greedy_cover(const SetCoverProblem& problem) {
  std::vector<int> chosen;
  add_greedily(problem, all_elements(problem), chosen);
  drop_needless(problem, chosen);
  return finished(problem, std::move(chosen));
}

SetCover exact_cover(const SetCoverProblem& problem, std::int64_t most_nodes,
                     const RunContext& run) {
  return BranchAndBound(problem, most_nodes, run).search(greedy_cover(problem));
}

SetCover anneal_cover(const SetCoverProblem& problem, const AnnealOptions& options,
                      const RunContext& run) {
  const Qubo qubo = qubo_of(problem);
  const auto n = static_cast<std::size_t>(qubo.variables);
  std::vector<double> diagonal(n, 0);
  std::vector<std::vector<std::pair<int, double>>> neighbours(n);
  for (const Qubo::Entry& e : qubo.entries) {
    if (e.row == e.column) {
      diagonal[static_cast<std::size_t>(e.row)] += e.value;
      continue;
    }
    neighbours[static_cast<std::size_t>(e.row)].push_back({e.column, e.value});
    neighbours[static_cast<std::size_t>(e.column)].push_back({e.row, e.value});
  }
  SetCover best;
  for (int restart = 0; restart < options.restarts; ++restart) {
    Rng rng(run.seed, static_cast<std::uint64_t>(restart) + 500);
    std::vector<char> bits(n, 0);
    std::vector<double> field = diagonal;  // energy that setting a bit would add
    for (int sweep = 0; sweep < options.sweeps && !run.should_stop(); ++sweep) {
      const double share = static_cast<double>(sweep) / options.sweeps;
      const double temperature = 2 * qubo.penalty * std::pow(0.02 / (2 * qubo.penalty), share);
      for (std::size_t i = 0; i < n; ++i) {
        const double change = bits[i] ? -field[i] : field[i];
        if (change > 0 && rng.uniform() >= std::exp(-change / temperature)) continue;
        bits[i] = bits[i] ? 0 : 1;
        for (const auto& [other, value] : neighbours[i]) {
          field[static_cast<std::size_t>(other)] += bits[i] ? value : -value;
        }
      }
    }
    std::vector<int> chosen;
    Column open = all_elements(problem);
    for (std::size_t k = 0; k < problem.sets.size(); ++k) {
      if (!bits[k]) continue;
      chosen.push_back(static_cast<int>(k));
      remove(open, problem.sets[k]);
    }
    add_greedily(problem, open, chosen);
    drop_needless(problem, chosen);
    SetCover cover = finished(problem, std::move(chosen));
    if (restart == 0 || cover.cost < best.cost) best = std::move(cover);
  }
  return best;
}

}  // namespace hewn
