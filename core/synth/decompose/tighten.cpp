#include "core/synth/decompose/tighten.h"

#include <algorithm>

namespace hewn {
namespace {

class Tightening {
 public:
  Tightening(const SearchSpace& space, const SurfaceSet& surfaces, DecisionList& list)
      : space_(space), surfaces_(surfaces), list_(list) {}

  void run() {
    for (TermPtr& item : list_.items) {
      while (item->fills && tighten(item)) {
      }
    }
    drop_redundant_items(space_, list_.items, list_.base);
    find_work_ends();
  }

 private:
  struct Bound {
    TermLiteral literal;
    int removed = 0;  ///< cells
  };

  /// Adds the bound that removes most. False when there is none.
  bool tighten(TermPtr& item) {
    std::vector<Bound> bounds = bounds_of(*item);
    std::stable_sort(bounds.begin(), bounds.end(),
                     [](const Bound& a, const Bound& b) { return a.removed > b.removed; });
    return std::any_of(bounds.begin(), bounds.end(),
                       [&](const Bound& bound) { return accept(item, bound.literal); });
  }

  /// Sides of planes on which the term's share of the solid lies as a whole.
  std::vector<Bound> bounds_of(const Term& term) const {
    std::vector<Bound> bounds;
    for (std::size_t k = 0; k < surfaces_.halfspaces.size(); ++k) {
      if (!space_.combinability->is_plane(static_cast<int>(k))) continue;
      for (const bool inside : {false, true}) {
        const int removed = count_removed(term, k, inside);
        if (removed > 0) bounds.push_back({{static_cast<int>(k), inside}, removed});
      }
    }
    return bounds;
  }

  /// Cells that the term loses to the bound; 0 when the solid has one of them.
  int count_removed(const Term& term, std::size_t plane, bool inside) const {
    const Word* kept = space_.columns->column(plane, inside);
    const std::vector<Word>& wanted = space_.columns->wanted();
    int removed = 0;
    for (std::size_t i = 0; i < term.cover.size(); ++i) {
      const Word lost = term.cover[i] & space_.care[i] & ~kept[i];
      if ((lost & wanted[i]) != 0) return 0;
      removed += std::popcount(lost);
    }
    return removed;
  }

  void find_work_ends() {
    std::vector<TermPtr> bounded = list_.items;  // as if every term ended there
    for (std::size_t k = 0; k < bounded.size(); ++k) {
      if (bounded[k]->fills) continue;
      Term term = *bounded[k];
      term.work_ends = work_ends_of(term, needed_of(bounded, k));
      if (term.work_ends.empty()) continue;
      list_.items[k] = std::make_shared<const Term>(term);
      term.literals.insert(term.literals.end(), term.work_ends.begin(), term.work_ends.end());
      bounded[k] = with_cover(*space_.columns, term);
    }
  }

  /// The cells that would be filled without a cutting item.
  std::vector<Word> needed_of(const std::vector<TermPtr>& items, std::size_t k) const {
    std::vector<Word> needed(space_.words());
    evaluate_list({items.data() + k + 1, items.size() - k - 1}, list_.base, needed);
    for (std::size_t i = 0; i < needed.size(); ++i) {
      needed[i] &= items[k]->cover[i] & space_.care[i];
      for (std::size_t before = 0; before < k; ++before) needed[i] &= ~items[before]->cover[i];
    }
    return needed;
  }

  /// On each side the nearest plane beyond which the term has nothing to do.
  std::vector<TermLiteral> work_ends_of(const Term& term, const std::vector<Word>& needed) const {
    std::vector<Bound> bounds;
    for (std::size_t k = 0; k < surfaces_.halfspaces.size(); ++k) {
      if (!space_.combinability->is_plane(static_cast<int>(k))) continue;
      for (const bool inside : {false, true}) {
        const Word* kept = space_.columns->column(k, inside);
        int removed = 0;
        bool is_enough = true;
        for (std::size_t i = 0; i < needed.size() && is_enough; ++i) {
          is_enough = (needed[i] & ~kept[i]) == 0;
          removed += std::popcount(term.cover[i] & ~kept[i]);
        }
        if (is_enough && removed > 0) bounds.push_back({{static_cast<int>(k), inside}, removed});
      }
    }
    std::stable_sort(bounds.begin(), bounds.end(),
                     [](const Bound& a, const Bound& b) { return a.removed > b.removed; });
    std::vector<TermLiteral> ends;
    for (const Bound& bound : bounds) {
      const auto is_beside = [&](const TermLiteral& l) {
        return is_on_same_side(l, bound.literal);
      };
      if (std::any_of(ends.begin(), ends.end(), is_beside)) continue;
      std::vector<TermLiteral> all = term.literals;
      all.insert(all.end(), ends.begin(), ends.end());
      all.push_back(bound.literal);
      if (term_cost(all, *space_.combinability) <= term.cost) ends.push_back(bound.literal);
    }
    return ends;
  }

  bool accept(TermPtr& item, const TermLiteral& bound) {
    Term candidate = *item;
    std::erase_if(candidate.literals,
                  [&](const TermLiteral& l) { return is_on_same_side(l, bound); });
    candidate.literals.push_back(bound);
    candidate.cost = term_cost(candidate.literals, *space_.combinability);
    if (candidate.cost > item->cost) return false;
    const TermPtr old = item;
    item = with_cover(*space_.columns, candidate);
    if (is_right(space_, list_.items, list_.base)) return true;
    item = old;
    return false;
  }

  /// Whether both are planes of one direction that bound the term on the same side.
  bool is_on_same_side(const TermLiteral& a, const TermLiteral& b) const {
    const Halfspace& p = surfaces_.halfspaces[static_cast<std::size_t>(a.halfspace)];
    const Halfspace& q = surfaces_.halfspaces[static_cast<std::size_t>(b.halfspace)];
    if (p.surface.kind != SurfaceKind::Plane || p.direction != q.direction) return false;
    const bool is_turned = p.surface.axis.dot(q.surface.axis) < 0;
    return (a.inside == b.inside) != is_turned;
  }

  const SearchSpace& space_;
  const SurfaceSet& surfaces_;
  DecisionList& list_;
};

}  // namespace

void tighten_list(const SearchSpace& space, const SurfaceSet& surfaces, DecisionList& list) {
  if (is_right(space, list.items, list.base)) Tightening(space, surfaces, list).run();
}

}  // namespace hewn
