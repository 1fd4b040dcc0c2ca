// Espresso's loop of expand, irredundant and reduce (Brayton et al. 1984).
#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/rng.h"
#include "core/synth/twolevel/two_level.h"

namespace hewn {
namespace {

class Espresso {
 public:
  Espresso(const TwoLevelProblem& problem, const RunContext& run) : problem_(problem), run_(run) {}

  Result<std::vector<Cube>> minimise() {
    cover_all_rows();
    irredundant();
    std::vector<Cube> best = cubes_;
    int best_cost = cost();
    while (!run_.is_cancelled()) {
      reduce();
      expand();
      cover_all_rows();
      irredundant();
      if (cost() >= best_cost) break;
      best = cubes_;
      best_cost = cost();
    }
    if (run_.is_cancelled()) return RunContext::cancelled();
    return best;
  }

 private:
  int cost() const {
    int n = 0;
    for (const Cube& cube : cubes_) n += std::max(1, cube.literals());
    return n;
  }

  /// Grows a prime from the term of every row that is not held yet.
  void cover_all_rows() {
    Column open = problem_.on;
    for (const Cube& cube : cubes_) remove(open, rows_of(cube, problem_));
    for (std::size_t w = 0; w < open.size(); ++w) {
      while (open[w] != 0 && !run_.is_cancelled()) {
        const std::size_t row = w * 64 + static_cast<std::size_t>(std::countr_zero(open[w]));
        cubes_.push_back(expanded_towards(cube_of_row(problem_, row), problem_, open));
        remove(open, rows_of(cubes_.back(), problem_));
      }
    }
  }

  static void remove(Column& from, const Column& what) {
    for (std::size_t i = 0; i < from.size(); ++i) from[i] &= ~what[i];
  }

  /// Rows of `on` that no other cube holds.
  Column own_rows(std::size_t index) const {
    Column own = rows_of(cubes_[index], problem_);
    for (std::size_t i = 0; i < own.size(); ++i) own[i] &= problem_.on[i];
    for (std::size_t k = 0; k < cubes_.size(); ++k) {
      if (k != index) remove(own, rows_of(cubes_[k], problem_));
    }
    return own;
  }

  /// The longest cubes go first.
  void irredundant() {
    std::stable_sort(cubes_.begin(), cubes_.end(),
                     [](const Cube& a, const Cube& b) { return a.literals() > b.literals(); });
    for (std::size_t i = 0; i < cubes_.size() && !run_.is_cancelled();) {
      const bool is_needed = intersects(own_rows(i), problem_.on);
      if (!is_needed) cubes_.erase(cubes_.begin() + static_cast<std::ptrdiff_t>(i));
      if (is_needed) ++i;
    }
  }

  /// Shrinks each cube to the smallest one around the rows that only it holds.
  void reduce() {
    for (std::size_t i = 0; i < cubes_.size() && !run_.is_cancelled(); ++i) {
      const Column own = own_rows(i);
      for (std::size_t k = 0; k < cubes_[i].sides.size(); ++k) {
        const Column& variable = problem_.rows.column(static_cast<int>(k));
        bool has_inside = false;
        bool has_outside = false;
        for (std::size_t w = 0; w < own.size(); ++w) {
          has_inside = has_inside || (own[w] & variable[w]) != 0;
          has_outside = has_outside || (own[w] & ~variable[w]) != 0;
        }
        if (has_inside != has_outside) {
          cubes_[i].sides[k] = has_inside ? Cube::Side::Inside : Cube::Side::Outside;
        }
      }
    }
  }

  /// Towards rows that other cubes hold, so that those may become redundant.
  void expand() {
    std::reverse(cubes_.begin(), cubes_.end());
    for (Cube& cube : cubes_) {
      if (run_.is_cancelled()) return;
      cube = expanded_towards(std::move(cube), problem_, problem_.on);
    }
  }

  const TwoLevelProblem& problem_;
  const RunContext& run_;
  std::vector<Cube> cubes_;
};

}  // namespace

Result<std::vector<Cube>> espresso(const TwoLevelProblem& problem, const RunContext& run) {
  return Espresso(problem, run).minimise();
}

std::vector<Cube> prime_implicants(const TwoLevelProblem& problem, const TwoLevelOptions& options,
                                   const RunContext& run) {
  Rng rng(run.seed, 77);
  std::vector<int> order(problem.literals.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
  std::vector<Cube> primes;
  for_each_bit(problem.on, [&](std::size_t row) {
    if (run.is_cancelled()) return;
    std::vector<int> tried = order;
    for (int i = 0; i < options.expansions_per_row; ++i) {
      primes.push_back(expanded(cube_of_row(problem, row), problem, tried));
      rng.shuffle(tried);
    }
  });
  std::sort(primes.begin(), primes.end(),
            [](const Cube& a, const Cube& b) { return a.sides < b.sides; });
  primes.erase(std::unique(primes.begin(), primes.end(),
                           [](const Cube& a, const Cube& b) { return a.sides == b.sides; }),
               primes.end());
  return primes;
}

Result<std::vector<Cube>> set_cover(const TwoLevelProblem& problem, bool by_annealing,
                                    const TwoLevelOptions& options, const RunContext& run) {
  const std::vector<Cube> primes = prime_implicants(problem, options, run);
  const SetCoverProblem covering = covering_problem(primes, problem);
  const SetCover cover = by_annealing ? anneal_cover(covering, options.anneal, run)
                                      : exact_cover(covering, options.most_branches, run);
  if (run.is_cancelled()) return RunContext::cancelled();
  std::vector<Cube> chosen;
  for (const int k : cover.chosen) chosen.push_back(primes[static_cast<std::size_t>(k)]);
  return chosen;
}

}  // namespace hewn
