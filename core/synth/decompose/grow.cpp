#include "core/synth/decompose/grow.h"

#include <algorithm>
#include <cmath>

namespace hewn {
namespace {

constexpr std::size_t kMaxLiterals = 24;
/// A plane that joins a box or caps a cylinder costs less than a new primitive.
constexpr double kJoiningCost = 0.25;

}  // namespace

TermGrower::TermGrower(const ColumnTable& columns, const Combinability& combinability)
    : columns_(&columns), combinability_(&combinability) {
  log_.resize(columns.cells() + 1, 0);
  for (std::size_t i = 1; i < log_.size(); ++i) log_[i] = std::log(static_cast<double>(i));
  for (std::size_t k = 0; k < columns.halfspaces(); ++k) {
    inside_columns_.push_back(columns.column(k, true));
  }
}

void TermGrower::set_open(const std::vector<Word>& open, const std::vector<Word>* required,
                          const PairsByKind& pairs) {
  open_ = &open;
  required_ = required;
  pairs_ = pairs;
  for (GrowthStart& s : starts_) s.forget();
}

GrowthStart& TermGrower::start_of(const GrowRequest& request) {
  const std::size_t kind = kind_of(request);
  GrowthStart& start = starts_[kind];
  if (!start.is_known()) {
    start.reset(*columns_, *open_, request.gains_required ? required_ : nullptr, request.fills,
                pairs_[kind]);
  }
  return start;
}

void TermGrower::start(const GrowRequest& request) {
  start_ = &start_of(request);
  share(start_->root());
  literals_.clear();
  prism_ = -1;
  has_planes_ = false;
  primitives_ = 0;
  candidates_.clear();
  for (std::size_t k = 0; k < columns_->halfspaces(); ++k) {
    const int halfspace = static_cast<int>(k);
    candidates_.push_back({halfspace,
                           test_bit(columns_->column(k, true), request.seed),
                           combinability_->is_plane(halfspace),
                           true,
                           false,
                           {}});
  }
}

void TermGrower::share(CountedCells& counted) {
  shared_ = &counted;
  cells_ = &counted.cells;
  left_ = counted.left;
}

void TermGrower::take(int halfspace, bool inside) {
  const bool is_first = literals_.empty();
  literals_.push_back({halfspace, inside});
  if (is_first) {
    share(start_->after(static_cast<std::size_t>(halfspace), inside));
  } else {
    shared_ = nullptr;
    own_cells_.take_in(*cells_, columns_->column(static_cast<std::size_t>(halfspace), inside));
    cells_ = &own_cells_;
    left_ = own_cells_.count();
  }
  const bool is_plane = combinability_->is_plane(halfspace);
  has_planes_ = has_planes_ || is_plane;
  // The side that was taken excludes nothing from now on: it goes when candidates are counted.
  for (Candidate& c : candidates_) {
    if (!c.is_plane) continue;
    if (is_plane) {
      c.shares_box = c.shares_box && combinability_->share_box(halfspace, c.halfspace);
    } else if (inside) {
      c.is_cap = c.is_cap || combinability_->caps(c.halfspace, halfspace);
    }
  }
}

bool TermGrower::take_curved(const GrowRequest& request, Rng& rng) {
  if (request.mode != GrowMode::CappedCurved && request.mode != GrowMode::CurvedFirst) return true;
  std::vector<int> curved;
  for (const Candidate& c : candidates_) {
    if (c.inside && !c.is_plane) curved.push_back(c.halfspace);
  }
  std::vector<int> prisms;
  for (std::size_t k = 0; k < combinability_->prisms().size(); ++k) {
    if (may_hold_seed(combinability_->prisms()[k])) prisms.push_back(static_cast<int>(k));
  }
  if (curved.empty() && prisms.empty()) return false;
  const std::size_t pick = rng.below(curved.size() + prisms.size());
  if (pick < curved.size()) {
    take(curved[pick], true);
  } else {
    take_prism(prisms[pick - curved.size()]);
  }
  primitives_ = 1;
  return true;
}

bool TermGrower::may_hold_seed(const RegularPrism& prism) const {
  return std::all_of(prism.sides.begin(), prism.sides.end(), [this](const TermLiteral& side) {
    return candidates_[static_cast<std::size_t>(side.halfspace)].inside == side.inside;
  });
}

void TermGrower::take_prism(int prism) {
  prism_ = prism;
  for (const TermLiteral& side : combinability_->prisms()[static_cast<std::size_t>(prism)].sides) {
    take(side.halfspace, side.inside);
  }
  for (Candidate& c : candidates_) {
    c.is_cap = c.is_cap || (c.is_plane && combinability_->caps_prism(c.halfspace, prism));
  }
}

/// Of the prism that was taken: without it the others would cost more.
bool TermGrower::is_prism_side(const TermLiteral& literal) const {
  if (prism_ < 0) return false;
  const auto& sides = combinability_->prisms()[static_cast<std::size_t>(prism_)].sides;
  return std::find(sides.begin(), sides.end(), literal) != sides.end();
}

double TermGrower::gain_of(CommonCounts kept) const {
  const double base = log_[left_.b] - log_[left_.b + left_.a];
  return kept.b * (log_[kept.b] - log_[kept.b + kept.a] - base);
}

/// Of all halfspaces' insides; what an outside keeps is the rest.
void TermGrower::count_shared() {
  if (!shared_->sides.empty()) return;
  counts_.resize(inside_columns_.size());
  start_->count_insides(*shared_, inside_columns_, counts_);
  for (const CommonCounts inside : counts_) {
    const CommonCounts outside{left_.a - inside.a, left_.b - inside.b};
    shared_->sides.push_back({outside, gain_of(outside)});
    shared_->sides.push_back({inside, gain_of(inside)});
  }
}

void TermGrower::count_own() {
  candidate_columns_.clear();
  for (const Candidate& c : candidates_) {
    candidate_columns_.push_back(columns_->column(static_cast<std::size_t>(c.halfspace), c.inside));
  }
  counts_.resize(candidates_.size());
  cells_->count(candidate_columns_, counts_);
}

/// Of the candidate with that index, whose sides have been counted.
SideWorth TermGrower::worth_of(std::size_t candidate) const {
  if (shared_ == nullptr) return {counts_[candidate], gain_of(counts_[candidate])};
  const Candidate& c = candidates_[candidate];
  return shared_->sides[2 * static_cast<std::size_t>(c.halfspace) + (c.inside ? 1 : 0)];
}

/// Counts what each candidate keeps, and forgets those that exclude nothing: they never will again.
void TermGrower::count_candidates() {
  if (shared_ != nullptr) {
    count_shared();
  } else {
    count_own();
  }
  // Which ones go is hard to foretell: no branch depends on it.
  std::size_t kept = 0;
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    const SideWorth worth = worth_of(k);
    Candidate& c = candidates_[kept] = candidates_[k];
    c.worth = worth;
    kept += worth.kept.a == left_.a ? 0 : 1;
  }
  candidates_.resize(kept);
}

double TermGrower::marginal_cost(const Candidate& candidate) const {
  if (!candidate.is_plane) return 1;
  return candidate.is_cap || (has_planes_ && candidate.shares_box) ? kJoiningCost : 1;
}

bool TermGrower::is_preferred(GrowMode mode, const Candidate& candidate) const {
  switch (mode) {
    case GrowMode::CappedCurved:
      return candidate.is_plane && candidate.is_cap;
    case GrowMode::SingleBox:
      return candidate.is_plane && candidate.shares_box;
    case GrowMode::Free:
    case GrowMode::CurvedFirst:
      return true;
  }
  return true;
}

TermGrower::Choice TermGrower::choose(const GrowRequest& request, bool preferred_only,
                                      Rng& rng) const {
  Choice best;
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    const Candidate& c = candidates_[k];
    if (preferred_only && !is_preferred(request.mode, c)) continue;
    double gain = c.worth.gain / marginal_cost(c);
    // The random factor is drawn only where it can matter.
    if (gain * (1 + request.noise) <= best.gain) continue;
    if (request.noise > 0) gain *= 1 + request.noise * (2 * rng.uniform() - 1);
    if (gain > best.gain) best = {gain, k, true};
  }
  return best;
}

bool TermGrower::is_pure_without(std::size_t skipped) const {
  const OpenCells& open = start_->root().cells;
  return open.has_no_others_in([&](std::size_t block, Word* cells) {
    for (std::size_t m = 0; m < literals_.size(); ++m) {
      if (m == skipped) continue;
      const Word* column =
          columns_->column(static_cast<std::size_t>(literals_[m].halfspace), literals_[m].inside);
      Word any = 0;
      for (std::size_t i = 0; i < kWordBlock; ++i) any |= cells[i] &= column[block + i];
      if (any == 0) return;
    }
  });
}

/// Removes literals, the first first, that purity does not need.
void TermGrower::drop_redundant() {
  for (std::size_t k = 0; k < literals_.size() && literals_.size() > 1;) {
    if (!is_prism_side(literals_[k]) && is_pure_without(k)) {
      literals_.erase(literals_.begin() + static_cast<long>(k));
    } else {
      ++k;
    }
  }
}

std::optional<Term> TermGrower::grow(const GrowRequest& request) {
  ++terms_grown_;
  Rng rng(request.random);
  start(request);
  if (!take_curved(request, rng)) return std::nullopt;
  while (left_.a > 0) {
    count_candidates();
    Choice best = choose(request, true, rng);
    if (!best.found) best = choose(request, false, rng);
    if (!best.found || literals_.size() == kMaxLiterals) return std::nullopt;
    const Candidate chosen = candidates_[best.candidate];
    if (marginal_cost(chosen) == 1 && ++primitives_ > request.max_cost + 1) return std::nullopt;
    take(chosen.halfspace, chosen.inside);
  }
  drop_redundant();
  Term term;
  term.literals = literals_;
  term.fills = request.fills;
  term.cost = term_cost(literals_, *combinability_);
  term.cover = columns_->all();
  for (const TermLiteral& l : literals_) {
    const Word* column = columns_->column(static_cast<std::size_t>(l.halfspace), l.inside);
    for (std::size_t i = 0; i < term.cover.size(); ++i) term.cover[i] &= column[i];
  }
  return term;
}

}  // namespace hewn
