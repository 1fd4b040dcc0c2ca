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
  others_at_start_ = others_;
  literals_.clear();
  candidates_.clear();
  for (std::size_t k = 0; k < columns_->halfspaces(); ++k) {
    candidates_.push_back({static_cast<int>(k), test_bit(columns_->column(k, true), request.seed)});
  }
}

void TermGrower::take(int halfspace, bool inside) {
  literals_.push_back({halfspace, inside});
  const Word* column = columns_->column(static_cast<std::size_t>(halfspace), inside);
  for (std::size_t i = 0; i < others_.size(); ++i) {
    others_[i] &= column[i];
    same_[i] &= column[i];
  }
  std::erase_if(candidates_, [=](const TermLiteral& c) { return c.halfspace == halfspace; });
}

bool TermGrower::take_curved(const GrowRequest& request, Rng& rng, int& restrict_to) {
  if (request.mode != GrowMode::CappedCurved && request.mode != GrowMode::CurvedFirst) return true;
  std::vector<int> curved;
  for (const TermLiteral& c : candidates_) {
    if (c.inside && !combinability_->is_plane(c.halfspace)) curved.push_back(c.halfspace);
  }
  if (curved.empty()) return false;
  const int chosen = curved[rng.below(curved.size())];
  take(chosen, true);
  if (request.mode == GrowMode::CappedCurved) restrict_to = chosen;
  return true;
}

/// Counts what each candidate keeps, and forgets those that exclude nothing: they never will again.
void TermGrower::count_candidates(int others) {
  candidate_columns_.clear();
  for (const TermLiteral& c : candidates_) {
    candidate_columns_.push_back(columns_->column(static_cast<std::size_t>(c.halfspace), c.inside));
  }
  counts_.resize(candidates_.size());
  bit_kernels().count_common(others_.data(), same_.data(), candidate_columns_, columns_->words(),
                             counts_);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    if (counts_[k].a == others) continue;
    candidates_[kept] = candidates_[k];
    counts_[kept++] = counts_[k];
  }
  candidates_.resize(kept);
  counts_.resize(kept);
}

double TermGrower::marginal_cost(int plane) const {
  bool has_planes = false;
  bool joins = true;
  for (const TermLiteral& l : literals_) {
    if (!combinability_->is_plane(l.halfspace)) {
      if (l.inside && combinability_->caps(plane, l.halfspace)) return kJoiningCost;
      continue;
    }
    has_planes = true;
    joins = joins && combinability_->share_box(l.halfspace, plane);
  }
  return has_planes && joins ? kJoiningCost : 1;
}

TermGrower::Choice TermGrower::choose(const GrowRequest& request, int others, int restrict_to,
                                      bool preferred_only, Rng& rng) const {
  Choice best;
  const int same = bit_kernels().count(same_.data(), columns_->words());
  const double base = log_[same] - log_[same + others];
  const bool planes_only =
      request.mode == GrowMode::CappedCurved || request.mode == GrowMode::SingleBox;
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    const int h = candidates_[k].halfspace;
    const bool is_plane = combinability_->is_plane(h);
    if (preferred_only && planes_only && !is_plane) continue;
    const double cost = is_plane ? marginal_cost(h) : 1;
    if (preferred_only && restrict_to >= 0 && !combinability_->caps(h, restrict_to)) continue;
    if (preferred_only && request.mode == GrowMode::SingleBox && !literals_.empty() && cost == 1) {
      continue;
    }
    const int kept = counts_[k].b;
    double gain = kept * (log_[kept] - log_[kept + counts_[k].a] - base) / cost;
    if (request.noise > 0) gain *= 1 + request.noise * (2 * rng.uniform() - 1);
    if (gain <= 0) gain = 1e-9 * (others - counts_[k].a);
    if (gain > best.gain) best = {gain, k, true};
  }
  return best;
}

bool TermGrower::is_pure_without(std::size_t skipped) const {
  for (std::size_t i = 0; i < others_at_start_.size(); ++i) {
    Word rest = others_at_start_[i];
    for (std::size_t k = 0; rest != 0 && k < literals_.size(); ++k) {
      if (k == skipped) continue;
      rest &= columns_->column(static_cast<std::size_t>(literals_[k].halfspace),
                               literals_[k].inside)[i];
    }
    if (rest != 0) return false;
  }
  return true;
}

void TermGrower::drop_redundant() {
  for (std::size_t k = 0; k < literals_.size() && literals_.size() > 1;) {
    if (is_pure_without(k)) {
      literals_.erase(literals_.begin() + static_cast<long>(k));
    } else {
      ++k;
    }
  }
}

std::optional<Term> TermGrower::grow(const GrowRequest& request, Rng& rng) {
  ++terms_grown_;
  start(request);
  int restrict_to = -1;
  if (!take_curved(request, rng, restrict_to)) return std::nullopt;
  for (;;) {
    const int others = bit_kernels().count(others_.data(), columns_->words());
    if (others == 0) break;
    count_candidates(others);
    Choice best = choose(request, others, restrict_to, true, rng);
    if (!best.found) best = choose(request, others, restrict_to, false, rng);
    if (!best.found || literals_.size() == kMaxLiterals) return std::nullopt;
    const TermLiteral chosen = candidates_[best.candidate];
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
