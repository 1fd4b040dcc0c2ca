#include "core/synth/decompose/pull_out.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace hewn {
namespace {

/// Whether a term is less by the whole of a primitive there.
bool is_taken_out(const TermLiteral& literal, const Combinability& combinability) {
  return !literal.inside && !combinability.is_plane(literal.halfspace);
}

std::vector<TermLiteral> taken_out(const SearchSpace& space, const DecisionList& list) {
  std::vector<TermLiteral> all;
  for (const TermPtr& item : list.items) {
    if (!item->fills) continue;
    for (const TermLiteral& l : item->literals) {
      const bool is_new = std::find(all.begin(), all.end(), l) == all.end();
      if (is_new && is_taken_out(l, *space.combinability)) all.push_back(l);
    }
  }
  return all;
}

Term without(const Term& term, const TermLiteral& literal) {
  Term less = term;
  std::erase(less.literals, literal);
  return less;
}

/// Drops what the terms that fill exclude without need.
void widen(const SearchSpace& space, DecisionList& list) {
  for (TermPtr& item : list.items) {
    if (!item->fills) continue;
    const TermPtr whole = item;
    for (const TermLiteral& l : whole->literals) {
      if (!is_taken_out(l, *space.combinability) || item->literals.size() < 2) continue;
      replace_item(space, list, item, without(*item, l));
    }
  }
}

/// Nothing when that would not be right.
std::optional<DecisionList> pulled_out(const SearchSpace& space, const DecisionList& list,
                                       const TermLiteral& literal) {
  Term cut;
  cut.fills = false;
  cut.literals = {{literal.halfspace, !literal.inside}};
  DecisionList changed{{finished_term(space, std::move(cut))}, list.base};
  for (const TermPtr& item : list.items) {
    const auto& l = item->literals;
    const bool has_it = item->fills && std::find(l.begin(), l.end(), literal) != l.end();
    const bool is_less = has_it && l.size() > 1;
    changed.items.push_back(is_less ? finished_term(space, without(*item, literal)) : item);
  }
  if (!is_right(space, changed.items, changed.base)) return std::nullopt;
  widen(space, changed);
  drop_redundant_items(space, changed.items, changed.base);
  return changed;
}

}  // namespace

bool pull_out_cuts(const SearchSpace& space, DecisionList& list) {
  const int before = list.cost();
  for (const TermLiteral& literal : taken_out(space, list)) {
    std::optional<DecisionList> changed = pulled_out(space, list, literal);
    if (changed && changed->cost() < list.cost()) list = std::move(*changed);
  }
  return list.cost() < before;
}

}  // namespace hewn
