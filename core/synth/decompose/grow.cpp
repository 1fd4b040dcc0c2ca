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
  others_.resize(columns.words());
  others_at_start_.resize(columns.words());
  same_.resize(columns.words());
  rest_.resize(columns.words());
}

void TermGrower::start(const GrowRequest& request) {
  const std::vector<Word>& wanted = columns_->wanted();
  const Word flip = request.fills ? 0 : ~Word{0};
  for (std::size_t i = 0; i < others_.size(); ++i) {
    const Word fits = wanted[i] ^ flip;
    others_[i] = (*request.open)[i] & ~fits;
    same_[i] = (*request.open)[i] & fits;
    if (request.required != nullptr) same_[i] &= (*request.required)[i];
  }
  blocks_.clear();
  for (std::size_t i = 0; i < others_.size(); i += kWordBlock) {
    blocks_.push_back(static_cast<std::uint32_t>(i));
  }
  keep_common(columns_->all().data());
  others_at_start_ = others_;
  literals_.clear();
  prism_ = -1;
  has_planes_ = false;
  primitives_ = 0;
  candidates_.clear();
  for (std::size_t k = 0; k < columns_->halfspaces(); ++k) {
    const int halfspace = static_cast<int>(k);
    candidates_.push_back({halfspace, test_bit(columns_->column(k, true), request.seed),
                           combinability_->is_plane(halfspace), true, false});
  }
}

/// Cells are in spatial order: most blocks soon hold none that is left, and are forgotten.
void TermGrower::keep_common(const Word* column) {
  std::size_t kept = 0;
  for (const std::uint32_t block : blocks_) {
    Word any = 0;
    for (std::size_t i = block; i < block + kWordBlock; ++i) {
      others_[i] &= column[i];
      same_[i] &= column[i];
      any |= others_[i] | same_[i];
    }
    if (any != 0) blocks_[kept++] = block;
  }
  blocks_.resize(kept);
}

void TermGrower::take(int halfspace, bool inside) {
  literals_.push_back({halfspace, inside});
  keep_common(columns_->column(static_cast<std::size_t>(halfspace), inside));
  const bool is_plane = combinability_->is_plane(halfspace);
  has_planes_ = has_planes_ || is_plane;
  std::erase_if(candidates_, [=](const Candidate& c) { return c.halfspace == halfspace; });
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

/// Counts what each candidate keeps, and forgets those that exclude nothing: they never will again.
void TermGrower::count_candidates(int others) {
  candidate_columns_.clear();
  for (const Candidate& c : candidates_) {
    candidate_columns_.push_back(columns_->column(static_cast<std::size_t>(c.halfspace), c.inside));
  }
  counts_.resize(candidates_.size());
  bit_kernels().count_common_in(others_.data(), same_.data(), candidate_columns_, blocks_, counts_);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    if (counts_[k].a == others) continue;
    candidates_[kept] = candidates_[k];
    counts_[kept++] = counts_[k];
  }
  candidates_.resize(kept);
  counts_.resize(kept);
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

TermGrower::Choice TermGrower::choose(const GrowRequest& request, int others, bool preferred_only,
                                      Rng& rng) const {
  Choice best;
  const int same = bit_kernels().count(same_.data(), columns_->words());
  const double base = log_[same] - log_[same + others];
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    if (preferred_only && !is_preferred(request.mode, candidates_[k])) continue;
    const int kept = counts_[k].b;
    double gain =
        kept * (log_[kept] - log_[kept + counts_[k].a] - base) / marginal_cost(candidates_[k]);
    // The random factor is drawn only where it can matter.
    if (gain * (1 + request.noise) <= best.gain) continue;
    if (request.noise > 0) gain *= 1 + request.noise * (2 * rng.uniform() - 1);
    if (gain <= 0) gain = 1e-9 * (others - counts_[k].a);
    if (gain > best.gain) best = {gain, k, true};
  }
  return best;
}

/// Removes literals, the first first, that purity does not need.
void TermGrower::drop_redundant() {
  for (std::size_t k = 0; k < literals_.size() && literals_.size() > 1;) {
    if (is_prism_side(literals_[k])) {
      ++k;
      continue;
    }
    rest_ = others_at_start_;
    bool is_pure = false;
    for (std::size_t m = 0; m < literals_.size() && !is_pure; ++m) {
      if (m == k) continue;
      const Word* column =
          columns_->column(static_cast<std::size_t>(literals_[m].halfspace), literals_[m].inside);
      Word any = 0;
      for (std::size_t i = 0; i < rest_.size(); ++i) any |= rest_[i] &= column[i];
      is_pure = any == 0;
    }
    if (is_pure) {
      literals_.erase(literals_.begin() + static_cast<long>(k));
    } else {
      ++k;
    }
  }
}

std::optional<Term> TermGrower::grow(const GrowRequest& request, Rng& rng) {
  ++terms_grown_;
  start(request);
  if (!take_curved(request, rng)) return std::nullopt;
  for (;;) {
    const int others = bit_kernels().count(others_.data(), columns_->words());
    if (others == 0) break;
    count_candidates(others);
    Choice best = choose(request, others, true, rng);
    if (!best.found) best = choose(request, others, false, rng);
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
