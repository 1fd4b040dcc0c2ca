#pragma once
/// Growing one pure term from a seed cell, literal by literal.
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/rng.h"
#include "core/sample/cells.h"
#include "core/synth/decompose/term.h"
#include "core/synth/decompose/term_cost.h"

namespace hewn {

/// Which kind of term to prefer; others are taken only when the preferred kind cannot be pure.
enum class GrowMode { Free, CappedCurved, SingleBox, CurvedFirst };

struct GrowRequest {
  const std::vector<Word>* open = nullptr;      ///< cells not decided yet
  const std::vector<Word>* required = nullptr;  ///< count gain only here; null: all open cells
  std::size_t seed = 0;                         ///< a cell that the term must cover
  bool fills = true;
  double noise = 0;     ///< random factor on gains, for variety
  int max_cost = 1000;  ///< give up on terms that are bound to be dearer
  GrowMode mode = GrowMode::Free;
};

/// Grows terms by information gain per marginal cost (FOIL, Quinlan 1990), then drops literals
/// that purity does not need. Holds scratch memory: one per thread.
class TermGrower {
 public:
  TermGrower(const ColumnTable& columns, const Combinability& combinability);

  /// A term that covers the seed and no open cell of the other kind; nullopt when none was found.
  /// Cost: O(literals x halfspaces x words).
  std::optional<Term> grow(const GrowRequest& request, Rng& rng);

  long terms_grown() const { return terms_grown_; }

 private:
  /// A halfspace side that the term may still take.
  struct Candidate {
    int halfspace;
    bool inside;
    bool is_plane;
    bool shares_box;  ///< square to every plane taken so far
    bool is_cap;      ///< caps a curved literal or prism taken so far
  };
  struct Choice {
    double gain = 0;
    std::size_t candidate = 0;
    bool found = false;
  };
  void start(const GrowRequest& request);
  bool take_curved(const GrowRequest& request, Rng& rng);
  void take(int halfspace, bool inside);
  void keep_common(const Word* column);
  void take_prism(int prism);
  bool may_hold_seed(const RegularPrism& prism) const;
  bool is_prism_side(const TermLiteral& literal) const;
  void count_candidates(int others);
  Choice choose(const GrowRequest& request, int others, bool preferred_only, Rng& rng) const;
  bool is_preferred(GrowMode mode, const Candidate& candidate) const;
  double marginal_cost(const Candidate& candidate) const;
  void drop_redundant();

  const ColumnTable* columns_;
  const Combinability* combinability_;
  std::vector<double> log_;
  std::vector<Word> others_, others_at_start_, same_, rest_;
  std::vector<std::uint32_t> blocks_;  ///< where `others_` or `same_` have bits left
  std::vector<TermLiteral> literals_;
  int prism_ = -1;  ///< taken as a whole, if any
  bool has_planes_ = false;
  int primitives_ = 0;  ///< begun so far; dropping redundant literals may save one or two
  std::vector<Candidate> candidates_;
  std::vector<const Word*> candidate_columns_;
  std::vector<CommonCounts> counts_;
  long terms_grown_ = 0;
};

}  // namespace hewn
