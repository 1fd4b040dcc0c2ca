#include "core/synth/decompose/rebase.h"

#include <utility>

namespace hewn {
namespace {

/// Whether the item cuts off one halfspace, and what it leaves is convex.
bool cuts_halfspace(const Term& item, const Combinability& combinability) {
  if (item.fills || item.literals.size() != 1) return false;
  const TermLiteral& l = item.literals.front();
  return combinability.is_plane(l.halfspace) || !l.inside;
}

}  // namespace

bool rebase_list(const SearchSpace& space, DecisionList& list) {
  if (!list.base) return false;
  DecisionList changed;
  Term whole;
  for (const TermPtr& item : list.items) {
    if (cuts_halfspace(*item, *space.combinability)) {
      const TermLiteral& l = item->literals.front();
      whole.literals.push_back({l.halfspace, !l.inside});
    } else {
      changed.items.push_back(item);
    }
  }
  if (whole.literals.empty()) return false;
  changed.items.push_back(finished_term(space, std::move(whole)));
  if (changed.cost() >= list.cost() || !is_right(space, changed.items, false)) return false;
  list = std::move(changed);
  return true;
}

}  // namespace hewn
