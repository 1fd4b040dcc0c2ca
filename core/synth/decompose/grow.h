#pragma once
/// Growing one pure term from a seed cell, literal by literal.
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/rng.h"
#include "core/sample/cells.h"
#include "core/synth/decompose/growth_start.h"
#include "core/synth/decompose/term.h"
#include "core/synth/decompose/term_cost.h"

namespace hewn {

/// Which kind of term to prefer; others are taken only when the preferred kind cannot be pure.
enum class GrowMode { Free, CappedCurved, SingleBox, CurvedFirst };

struct GrowRequest {
  std::size_t seed = 0;  ///< a cell that the term must cover
  bool fills = true;
  bool gains_required = false;  ///< count gain only on the required cells, not on all open ones
  double noise = 0;             ///< random factor on gains, for variety
  int max_cost = 1000;          ///< give up on terms that are bound to be dearer
  GrowMode mode = GrowMode::Free;
  std::uint64_t random = 0;  ///< seeds the random numbers of this growth
};

/// The kinds of terms that share work.
inline constexpr std::size_t kGrowKinds = 4;
inline std::size_t kind_of(const GrowRequest& request) {
  return (request.fills ? 2 : 0) + (request.gains_required ? 1 : 0);
}
/// What pairs of halfspaces keep of the open cells as each kind of terms sees them; or nullptr.
using PairsByKind = std::array<const PairCounts*, kGrowKinds>;

/// Grows terms by information gain per marginal cost (FOIL, Quinlan 1990), then drops literals
/// that purity does not need. Holds scratch memory: one per thread.
class TermGrower {
 public:
  TermGrower(const ColumnTable& columns, const Combinability& combinability);

  /// The cells not decided yet, and those among them that gain may be restricted to. Terms grown
  /// from the same cells share work, which may have been done before (`pairs`). All must outlive
  /// the growing.
  void set_open(const std::vector<Word>& open, const std::vector<Word>* required = nullptr,
                const PairsByKind& pairs = {});

  /// A term that covers the seed and no open cell of the other kind; nullopt when none was found.
  /// Requires: `set_open`. Cost: O(literals x halfspaces x words).
  std::optional<Term> grow(const GrowRequest& request);

  long terms_grown() const { return terms_grown_; }

 private:
  /// A halfspace side that the term may still take.
  struct Candidate {
    int halfspace;
    bool inside;
    bool is_plane;
    bool shares_box;  ///< square to every plane taken so far
    bool is_cap;      ///< caps a curved literal or prism taken so far
    SideWorth worth;
  };
  struct Choice {
    double gain = 0;
    std::size_t candidate = 0;
    bool found = false;
  };
  GrowthStart& start_of(const GrowRequest& request);
  void start(const GrowRequest& request);
  bool take_curved(const GrowRequest& request, Rng& rng);
  void share(CountedCells& counted);
  void take(int halfspace, bool inside);
  void take_prism(int prism);
  bool may_hold_seed(const RegularPrism& prism) const;
  bool is_prism_side(const TermLiteral& literal) const;
  double gain_of(CommonCounts kept) const;
  void count_candidates();
  void count_shared();
  void count_own();
  SideWorth worth_of(std::size_t candidate) const;
  Choice choose(const GrowRequest& request, bool preferred_only, Rng& rng) const;
  bool is_preferred(GrowMode mode, const Candidate& candidate) const;
  double marginal_cost(const Candidate& candidate) const;
  bool is_pure_without(std::size_t skipped) const;
  void drop_redundant();

  const ColumnTable* columns_;
  const Combinability* combinability_;
  std::vector<double> log_;
  std::vector<const Word*> inside_columns_;  ///< by halfspace
  const std::vector<Word>* open_ = nullptr;
  const std::vector<Word>* required_ = nullptr;
  PairsByKind pairs_ = {};
  std::array<GrowthStart, kGrowKinds> starts_;
  GrowthStart* start_ = nullptr;
  CountedCells* shared_ = nullptr;    ///< `cells_` with what others have counted; null if own
  const OpenCells* cells_ = nullptr;  ///< that the term covers so far
  OpenCells own_cells_;               ///< memory for them, once they are not shared
  CommonCounts left_;                 ///< in `cells_`
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
