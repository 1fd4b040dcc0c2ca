#include "core/synth/decompose/tighten.h"

#include <algorithm>
#include <utility>

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
  /// Adds the bound that removes most of what the solid has not. False when there is none.
  bool tighten(TermPtr& item) {
    std::vector<Word> counted = item->cover;
    for (std::size_t i = 0; i < counted.size(); ++i) counted[i] &= space_.care[i];
    std::vector<Word> solid = counted;
    for (std::size_t i = 0; i < solid.size(); ++i) solid[i] &= space_.columns->wanted()[i];
    const std::vector<TermLiteral> bounds = bounds_around(solid, counted);
    return std::any_of(bounds.begin(), bounds.end(),
                       [&](const TermLiteral& bound) { return accept(item, bound); });
  }

  /// The sides of planes on which all of `kept` lies but not all of `counted`: those first that
  /// leave out most of it.
  std::vector<TermLiteral> bounds_around(const std::vector<Word>& kept,
                                         const std::vector<Word>& counted) const {
    std::vector<std::pair<int, TermLiteral>> bounds;
    for (std::size_t k = 0; k < surfaces_.halfspaces.size(); ++k) {
      if (!space_.combinability->is_plane(static_cast<int>(k))) continue;
      for (const bool inside : {false, true}) {
        const int removed = count_removed(kept, counted, space_.columns->column(k, inside));
        if (removed > 0) bounds.push_back({removed, {static_cast<int>(k), inside}});
      }
    }
    std::stable_sort(bounds.begin(), bounds.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<TermLiteral> out;
    out.reserve(bounds.size());
    for (const auto& [removed, literal] : bounds) out.push_back(literal);
    return out;
  }

  /// Cells of `counted` outside of `side`; 0 when one of `kept` is, too.
  static int count_removed(const std::vector<Word>& kept, const std::vector<Word>& counted,
                           const Word* side) {
    int removed = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if ((kept[i] & ~side[i]) != 0) return 0;
      removed += std::popcount(counted[i] & ~side[i]);
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
    std::vector<TermLiteral> ends;
    for (const TermLiteral& bound : bounds_around(needed, term.cover)) {
      const auto is_beside = [&](const TermLiteral& l) { return is_on_same_side(l, bound); };
      if (std::any_of(ends.begin(), ends.end(), is_beside)) continue;
      std::vector<TermLiteral> all = term.literals;
      all.insert(all.end(), ends.begin(), ends.end());
      all.push_back(bound);
      if (term_cost(all, *space_.combinability) <= term.cost) ends.push_back(bound);
    }
    return ends;
  }

  bool accept(TermPtr& item, const TermLiteral& bound) {
    Term candidate = *item;
    std::erase_if(candidate.literals,
                  [&](const TermLiteral& l) { return is_on_same_side(l, bound); });
    candidate.literals.push_back(bound);
    return replace_item(space_, list_, item, std::move(candidate));
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
