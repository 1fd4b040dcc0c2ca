#pragma once
/// A small formula for given cells, built from scratch.
#include <optional>

#include "core/base/rng.h"
#include "core/synth/simplify/formula.h"

namespace hewn {

/// What a formula has to do: hold all of `on` and nothing of `off`. Other cells are free.
struct CellTask {
  Column on, off;
};

/// Builds formulas by peeling dominant halfspaces off the solid and its complement with
/// don't-cares; where none dominates, by terms grown literal by literal (FOIL, Quinlan 1990).
class Resynthesis {
 public:
  explicit Resynthesis(const CellColumns& cells);

  /// A formula for the task with at most `budget` literals, or nothing when this try finds none.
  /// Random choices come from `rng`. Cost: O(budget x literals x words).
  std::optional<Formula> attempt(const CellTask& task, int budget, Rng& rng);

  /// Words that were looked at so far: a measure of work that no machine changes.
  double work() const { return work_; }

 private:
  struct Move {
    double score = 0;
    int literal = -1;
    bool is_negated = false;
    bool is_cut = false;  ///< intersect with it instead of uniting
  };

  std::optional<Formula> solve(CellTask& task, int budget, Rng& rng);
  std::optional<Formula> solve_counted(CellTask& task, int budget, Rng& rng);
  void count_common(const Column& a, const Column& b, std::vector<CommonCounts>& out);
  bool has_two_sides();
  bool count(const CellTask& task);
  bool take_away(CellTask& task, const Move& move);
  std::optional<Formula> single() const;
  Move best_peel(Rng& rng) const;
  std::optional<Formula> peel(CellTask& task, const Move& move, int budget, Rng& rng);
  std::optional<Formula> by_term(CellTask& task, int budget, Rng& rng);
  std::vector<Formula> grow(const CellTask& task, int longest, Rng& rng);

  const CellColumns& cells_;
  std::vector<const Word*> columns_;
  std::vector<std::uint32_t> blocks_;  ///< first words of blocks with any cell to count
  std::vector<CommonCounts> counts_;   ///< of the task's on and off in each literal
  Column taken_;                       ///< by the last peel
  std::vector<CommonCounts> taken_counts_;
  int on_ = 0, off_ = 0;
  double work_ = 0;
};

}  // namespace hewn
