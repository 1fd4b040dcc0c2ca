#include "core/synth/simplify/resynthesise.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hewn {
namespace {

using Kind = Formula::Kind;

constexpr int kLongestTerm = 6;

/// Keeps the cells on one side of a literal.
void keep(Column& cells, const Column& literal, bool is_inside) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] &= is_inside ? literal[i] : ~literal[i];
  }
}

std::size_t random_cell(const Column& cells, int count, Rng& rng) {
  std::size_t left = rng.below(static_cast<std::size_t>(count));
  for (std::size_t w = 0;; ++w) {
    const auto here = static_cast<std::size_t>(std::popcount(cells[w]));
    if (left >= here) {
      left -= here;
      continue;
    }
    Word rest = cells[w];
    for (; left > 0; --left) rest &= rest - 1;
    return w * 64 + static_cast<std::size_t>(std::countr_zero(rest));
  }
}

}  // namespace

Resynthesis::Resynthesis(const CellColumns& cells) : cells_(cells) {
  for (int k = 0; k < cells.literals(); ++k) columns_.push_back(cells.column(k).data());
  counts_.resize(columns_.size());
  taken_counts_.resize(columns_.size());
}

std::optional<Formula> Resynthesis::attempt(const CellTask& task, int budget, Rng& rng) {
  CellTask rest = task;
  return solve(rest, budget, rng);
}

/// What the cells, in one or two columns, have in common with every literal.
void Resynthesis::count_common(const Column& a, const Column& b, std::vector<CommonCounts>& out) {
  blocks_.clear();
  for (std::size_t block = 0; block < a.size(); block += kWordBlock) {
    Word any = 0;
    for (std::size_t i = block; i < block + kWordBlock; ++i) any |= a[i] | b[i];
    if (any != 0) blocks_.push_back(static_cast<std::uint32_t>(block));
  }
  bit_kernels().count_common_in(a.data(), b.data(), columns_, blocks_, out);
}

/// False when one side is empty: the answer is a constant.
bool Resynthesis::has_two_sides() {
  if (on_ == 0 || off_ == 0) return false;
  work_ += static_cast<double>(cells_.words()) * static_cast<double>(2 * columns_.size() + 20);
  return true;
}

/// Counts anew. False when one side is empty.
bool Resynthesis::count(const CellTask& task) {
  on_ = bit_kernels().count(task.on.data(), task.on.size());
  off_ = bit_kernels().count(task.off.data(), task.off.size());
  if (!has_two_sides()) return false;
  count_common(task.on, task.off, counts_);
  return true;
}

/// Takes the cells that the move decides out of its side of the task, and out of what was counted.
/// False when one side is empty then.
bool Resynthesis::take_away(CellTask& task, const Move& move) {
  Column& side = move.is_cut ? task.off : task.on;
  taken_ = side;
  keep(side, cells_.column(move.literal), move.is_cut != move.is_negated);
  for (std::size_t i = 0; i < side.size(); ++i) taken_[i] &= ~side[i];
  (move.is_cut ? off_ : on_) -= bit_kernels().count(taken_.data(), taken_.size());
  if (!has_two_sides()) return false;
  count_common(taken_, taken_, taken_counts_);
  for (std::size_t k = 0; k < counts_.size(); ++k) {
    (move.is_cut ? counts_[k].b : counts_[k].a) -= taken_counts_[k].a;
  }
  return true;
}

std::optional<Formula> Resynthesis::single() const {
  for (std::size_t k = 0; k < counts_.size(); ++k) {
    const CommonCounts& c = counts_[k];
    if (c.a == on_ && c.b == 0) return Formula::leaf(static_cast<int>(k));
    if (c.a == 0 && c.b == off_) return Formula::leaf(static_cast<int>(k), true);
  }
  return std::nullopt;
}

Resynthesis::Move Resynthesis::best_peel(Rng& rng) const {
  Move best;
  const auto offer = [&](std::size_t k, bool is_negated, bool is_cut, int gain, int total) {
    if (gain == 0) return;
    const double score = static_cast<double>(gain) / total * rng.uniform(0.5, 1);
    if (score > best.score) best = {score, static_cast<int>(k), is_negated, is_cut};
  };
  for (std::size_t k = 0; k < counts_.size(); ++k) {
    const CommonCounts& c = counts_[k];
    if (c.b == 0) offer(k, false, false, c.a, on_);
    if (c.b == off_) offer(k, true, false, on_ - c.a, on_);
    if (c.a == on_) offer(k, false, true, off_ - c.b, off_);
    if (c.a == 0) offer(k, true, true, c.b, off_);
  }
  return best;
}

std::optional<Formula> Resynthesis::solve(CellTask& task, int budget, Rng& rng) {
  if (!count(task)) return Formula::constant(on_ > 0);
  return solve_counted(task, budget, rng);
}

std::optional<Formula> Resynthesis::solve_counted(CellTask& task, int budget, Rng& rng) {
  if (budget < 1) return std::nullopt;
  if (auto literal = single()) return literal;
  if (budget < 2) return std::nullopt;
  const Move move = best_peel(rng);
  if (move.literal >= 0) return peel(task, move, budget, rng);
  return by_term(task, budget, rng);
}

std::optional<Formula> Resynthesis::peel(CellTask& task, const Move& move, int budget, Rng& rng) {
  auto rest =
      take_away(task, move) ? solve_counted(task, budget - 1, rng) : Formula::constant(on_ > 0);
  if (!rest) return std::nullopt;
  std::vector<Formula> parts;
  parts.push_back(Formula::leaf(move.literal, move.is_negated));
  parts.push_back(std::move(*rest));
  return Formula::join(move.is_cut ? Kind::And : Kind::Or, std::move(parts));
}

/// The literals of a term through a random cell of `on`, empty of `off`; nothing when none is
/// found.
std::vector<Formula> Resynthesis::grow(const CellTask& task, int longest, Rng& rng) {
  CellTask covered = task;
  const std::size_t seed = random_cell(task.on, on_, rng);
  std::vector<Formula> term;
  const int steps = std::min(longest, kLongestTerm);
  for (int step = 0; step < steps; ++step) {
    if (step > 0 && !count(covered)) break;
    const double before = std::log2(static_cast<double>(on_) / (on_ + off_));
    double best = 0;
    int literal = -1;
    for (std::size_t k = 0; k < counts_.size(); ++k) {
      const bool is_inside = test_bit(columns_[k], seed);
      const int on = is_inside ? counts_[k].a : on_ - counts_[k].a;
      const int off = is_inside ? counts_[k].b : off_ - counts_[k].b;
      if (off == off_) continue;
      const double after = std::log2(static_cast<double>(on) / (on + off));
      const double score = on * (after - before) * rng.uniform(0.6, 1);
      if (score <= best) continue;
      best = score;
      literal = static_cast<int>(k);
    }
    if (literal < 0) return {};
    const bool is_inside = test_bit(columns_[static_cast<std::size_t>(literal)], seed);
    term.push_back(Formula::leaf(literal, !is_inside));
    keep(covered.on, cells_.column(literal), is_inside);
    keep(covered.off, cells_.column(literal), is_inside);
    if (!intersects(covered.off, cells_.all())) return term;
  }
  return {};
}

std::optional<Formula> Resynthesis::by_term(CellTask& task, int budget, Rng& rng) {
  // On the complement's side everything is turned round.
  const bool is_turned = rng.below(static_cast<std::size_t>(on_) + static_cast<std::size_t>(off_)) <
                         static_cast<std::size_t>(on_);
  if (is_turned) {
    std::swap(task.on, task.off);
    count(task);
  }
  std::vector<Formula> term = grow(task, budget - 1, rng);
  if (term.empty()) return std::nullopt;
  Column covered = task.on;
  for (const Formula& literal : term) {
    keep(covered, cells_.column(literal.literal), !literal.is_negated);
  }
  for (std::size_t i = 0; i < covered.size(); ++i) task.on[i] &= ~covered[i];
  const int left = budget - static_cast<int>(term.size());
  auto rest = solve(task, left, rng);
  if (!rest) return std::nullopt;
  std::vector<Formula> parts;
  parts.push_back(Formula::join(Kind::And, std::move(term)));
  parts.push_back(std::move(*rest));
  Formula f = Formula::join(Kind::Or, std::move(parts));
  f.is_negated = is_turned;
  return f;
}

}  // namespace hewn
